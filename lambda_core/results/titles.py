"""Hold titles of publications from their title pages.

Laws name their sources by authors, year and journal; a bibliography wants the title too. What is not here has none.
"""

from __future__ import annotations

# First author, year, journal ("" for theses and books).
_GOKSEM = (
    "The Effect of Viscous Shear Heating on Both Film Thickness and Rolling Traction in an EHL Line Contact - "
    "Part I: Fully Flooded Conditions"
)
TITLES: dict[tuple[str, str, str], str] = {
    ("Archard", "1959", "Wear"): "The temperature of rubbing surfaces",
    ("Barz", "1996", ""): "Die Schmierfilmbildung in fettgeschmierten schnellaufenden Spindellagern",
    ("Carslaw", "1959", ""): "Conduction of Heat in Solids",
    ("Chittenden", "1985", "Proc. R. Soc. A"): (
        "A theoretical analysis of the isothermal elastohydrodynamic lubrication of concentrated contacts"
    ),
    ("Clift", "1978", ""): "Bubbles, Drops, and Particles",
    ("Goksem", "1978", "J. Lubr. Technol."): _GOKSEM,
    ("Goksem", "1978", ""): _GOKSEM,
    ("Gupta", "1992", "Tribol. Trans."): (
        "Viscoelastic Effects in MIL-L-7808-Type Lubricant, Part I: Analytical Formulation"
    ),
    ("Hamrock", "1977", "J. Lubr. Technol."): (
        "Isothermal Elastohydrodynamic Lubrication of Point Contacts: Part III - Fully Flooded Results"
    ),
    ("Hamrock", "1983", "J. Lubr. Technol."): "Simplified Solution for Stresses and Deformations",
    ("Johnson", "1977", "Proc. R. Soc. A"): "Shear behaviour of elastohydrodynamic oil films",
    ("Murch", "1975", "J. Lubr. Technol."): "A Thermal Elastohydrodynamic Inlet Zone Analysis",
    ("Sawalhi", "2008", "Mech. Syst. Signal Process."): (
        "Simulating gear and bearing interactions in the presence of faults: Part I. The combined gear bearing dynamic "
        "model and the simulation of localised bearing faults"
    ),
    ("Schneider", "2021", "Tribol. Int."): (
        "Empirical formulae for the influence of real film thickness distribution on the capacitance of an EHL point "
        "contact and application to rolling bearings"
    ),
    ("Teutsch", "2005", ""): "Kontaktmodelle und Strategien zur Simulation von Wälzlagern und Wälzführungen",
    ("Wardle", "1988", "Proc. Instn Mech. Engrs"): (
        "Vibration Forces Produced by Waviness of the Rolling Surfaces of Thrust Loaded Ball Bearings, Part 1: Theory"
    ),
    ("Wingertszahn", "2023", "Lubricants"): (
        "Predicting Friction of Tapered Roller Bearings with Detailed Multi-Body Simulation Models"
    ),
    ("Zhou", "1991", "J. Tribol."): "Torque of Tapered Roller Bearings",
}
