"""Give every contact a temperature that its traction reads.

Losses raise it, the bearing around it lowers it.
"""

from typing import NamedTuple

from lambda_core.plugins import OK, Context, Parameters, State, built_in, law, parameter

EYRING = built_in("traction/ree-eyring")
shear = EYRING.kernel


class Body(Parameters):
    conductance: float = parameter(0.2, "heat that leaves a contact, per kelvin [W/K]", status="assumed", gt=0.0)
    capacity: float = parameter(2e-3, "heat that warms a contact by a kelvin [J/K]", status="assumed", gt=0.0)


def oil(parameters: Body, context: Context) -> float:
    return context.oil.temperature


WARM = State("contact_temperature", "K", "temperature of each raceway contact", scale=1.0, start=oil)


@law("contact_state", "warm", Body, role_api=3, reference="own work: heat of one lump", states=(WARM,))
def warm(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):
    """Heat balance of a contact.

    C dT/dt = P - G (T - T_oil).
    """
    out[0] = (power - par.conductance * (par.contact_temperature - T_in)) / par.capacity
    return OK


class Film(NamedTuple):
    eyring: EYRING.parameters
    beta: float  # -d ln(eta)/dT [1/K]
    inlet: float  # oil temperature [K]


def prepare(parameters: EYRING.parameters, context: Context) -> Film:
    return Film(parameters, context.oil.beta, context.oil.temperature)


@law("traction", "warm-eyring", EYRING.parameters, role_api=3, reference=EYRING.reference, prepare=prepare,
     reads={"contact_temperature": 350.0})  # fmt: skip
def warm_eyring(slip, p, T, ln_eta, h, par, tau):
    """Film of Ree and Eyring, warmed.

    Its viscosity is lower by exp(-beta (T - T_oil)).
    """
    thinner = par.beta * (par.contact_temperature - par.inlet)
    for i in range(tau.size):
        tau[i] = ln_eta[i] - thinner
    # the law reads ln(eta) of a cell before it writes the stress there
    return shear(slip, p, T, tau, h, par.eyring, tau)
