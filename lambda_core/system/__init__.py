"""From a case to the resolved model: geometry, bodies, materials, laws, every value with its origin."""
