"""Compute the largest ball load by Stribeck's number."""

from lambda_core.plugins import Method, MethodInputs, MethodRow, MethodTable, NotApplicable

NO_CLEARANCE = 4.37  # Q_max Z/F_r of a radially loaded bearing without clearance
USUAL_CLEARANCE = 5.0  # rounded up for the clearance that bearings have


def stribeck(inputs: MethodInputs) -> MethodTable:
    """Compute the largest ball load after Stribeck.

    Radial load, Q_max = 4.37 F_r/Z, and 5 F_r/Z with clearance.
    """
    if inputs.radial_load <= 0.0:
        raise NotApplicable("Stribeck's number is for a radial load")
    if inputs.axial_load > 0.1 * inputs.radial_load:
        raise NotApplicable("Stribeck's number is for a radial load alone, within a tenth of it")
    mean = inputs.radial_load / inputs.ball_count
    return MethodTable(
        (
            MethodRow("load", "largest ball load", NO_CLEARANCE * mean, "N", "no clearance, rigid rings"),
            MethodRow("load", "largest ball load with clearance", USUAL_CLEARANCE * mean, "N", "usual clearance"),
        ),
        ("rigid rings; centrifugal force left out",),
    )


STRIBECK = Method(
    name="stribeck",
    title="Stribeck's largest ball load",
    reference="Stribeck 1907, Trans. ASME 29, 420: ball bearings for various loads",
    evaluate=stribeck,
    validity="pure radial load, deep-groove ball bearings",
    method_api=1,
)
