"""A brush tire with many bristles on a carcass of springs, steady or rolling through time.

A bristle enters the contact undeformed, is carried through it and deforms with the slip until
friction gives way (Pacejka, *Tire and Vehicle Dynamics*, 3rd ed., ch. 3). Nothing here knows the
Magic Formula or a relaxation length: the lag of the force behind the slip angle comes from the
transport of the bristles and from the carcass springs alone.

Axes inside: a positive slip angle gives a positive lateral force; ``x`` runs forwards.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

# Positions in the vector of tire and rig constants (see constants.TireConstants.vector).
(
    FZ0,
    RADIUS,
    HALF_LENGTH,
    LENGTH_EXPONENT,
    TREAD_X,
    TREAD_Y,
    CARCASS_X,
    CARCASS_Y,
    CARCASS_PSI,
    MU,
    MU_RATIO_X,
    MU_PRESSURE_EXPONENT,
    SLIDE_DROP,
    SLIDE_SLIP,
    PROFILE,
    PROFILE_SKEW,
    SPEED0,
    PRESSURE0,
    TEMPERATURE0,
    AMBIENT,
    HEAT_SHARE,
    HEAT_CAPACITY,
    COOLING,
    COOLING_SPEED,
    ROLLING_HEAT,
    BULK_EXCHANGE,
    BULK_RATE,
    WEAR_ENERGY,
    CAMBER_GAIN,
    COUPLING,
    TEMPERATURE_LINEAR,
    TEMPERATURE_SQUARE,
    TEMPERATURE_STIFFNESS,
    WEAR_STIFFNESS,
    PRESSURE_LENGTH,
    PRESSURE_STIFFNESS,
    PLYSTEER,
    CONICITY,
    RUNOUT_ANGLE,
    RUNOUT_LOAD,
    RUNOUT_PHASE,
    COMPLIANCE_FX,
    SURFACE_TIME,
    LOAD_CURVE,
) = range(44)
N_CONSTANTS = 44

# Positions in the vector of effect strengths; all zero is the tire that the clean run saw.
(
    E_FRICTION,
    E_STIFFNESS,
    E_LOAD,
    E_CAMBER,
    E_COUPLING,
    E_PRESSURE,
    E_TEMPERATURE,
    E_SPEED,
    E_RELAXATION,
    E_WEAR,
    E_PLY,
    E_TURN,
    E_NONUNIFORM,
    E_COMPLIANCE,
    E_SURFACE,
    E_SLIP_RATE,
    E_LOAD_RATE,
    E_MEMORY,
) = range(18)
N_EFFECTS = 18

# Columns of the table of inputs.
(ALPHA, KAPPA, GAMMA, FZ, SPEED, PRESSURE, TURN) = range(7)


@njit(cache=True)
def _contact(c, e, fz, speed, pressure, temperature, wear, memory, rates, time):
    """Half length, tread stiffnesses and friction of the contact as it stands now."""
    load = max(fz, 50.0) / c[FZ0]
    inflation = max(pressure, 1e4) / c[PRESSURE0]
    a = c[HALF_LENGTH] * load ** c[LENGTH_EXPONENT]
    a *= inflation ** (-e[E_PRESSURE] * c[PRESSURE_LENGTH])
    warm = (temperature - c[TEMPERATURE0]) / 50.0
    soft = 1.0 - e[E_TEMPERATURE] * c[TEMPERATURE_STIFFNESS] * warm
    hard = 1.0 + e[E_WEAR] * c[WEAR_STIFFNESS] * wear
    tread = max(soft, 0.2) * hard * (1.0 + e[E_STIFFNESS])
    tread *= inflation ** (e[E_PRESSURE] * c[PRESSURE_STIFFNESS])
    ground_pressure = load * c[HALF_LENGTH] / a
    exponent = c[MU_PRESSURE_EXPONENT] + e[E_LOAD]
    mu = c[MU] * ground_pressure ** (-exponent) * load ** (-c[LOAD_CURVE] - e[E_LOAD] * 0.4)
    mu *= 1.0 + e[E_FRICTION]
    grip = c[TEMPERATURE_LINEAR] * warm + c[TEMPERATURE_SQUARE] * warm * warm
    mu *= max(1.0 - e[E_TEMPERATURE] * grip, 0.2)
    mu *= max(1.0 - e[E_WEAR] * wear, 0.2)
    mu *= max(1.0 - e[E_SPEED] * math.log(max(speed, 0.5) / c[SPEED0]), 0.2)
    if time >= c[SURFACE_TIME]:
        mu *= 1.0 - e[E_SURFACE]
    mu *= max(1.0 + e[E_SLIP_RATE] * math.tanh(rates[0] / 0.3), 0.2)
    mu *= max(1.0 + e[E_LOAD_RATE] * math.tanh(rates[1] / (2.0 * c[FZ0])), 0.2)
    mu *= max(1.0 - e[E_MEMORY] * memory, 0.2)
    return a, c[TREAD_X] * tread, c[TREAD_Y] * tread, mu


@njit(cache=True)
def _hold(tx, ty, limit_x, limit_y, coupling):
    """Bristle shear held within the friction limit, whether it slides, and what of its stiffness
    is left along x and y: a bristle that slides forwards still resists a push sideways only by
    the turn of its friction force."""
    rx = tx / limit_x
    ry = ty / limit_y
    nx = rx * rx + coupling * ry * ry
    ny = coupling * rx * rx + ry * ry
    slides = False
    left_x = left_y = 1.0
    if nx > 1.0:
        root = math.sqrt(nx)
        tx /= root
        left_x = coupling * ry * ry / (nx * root)
        slides = True
    if ny > 1.0:
        root = math.sqrt(ny)
        ty /= root
        left_y = coupling * rx * rx / (ny * root)
        slides = True
    return tx, ty, slides, left_x, left_y


@njit(cache=True)
def _profile(c, n_bristles):
    """Ground pressure over its mean at every bristle, from the leading edge backwards."""
    n = c[PROFILE]
    out = np.empty(n_bristles)
    for j in range(n_bristles):
        xi = 1.0 - (2.0 * j + 1.0) / n_bristles
        out[j] = (n + 1.0) / n * (1.0 - abs(xi) ** n) * (1.0 + c[PROFILE_SKEW] * xi) + 1e-6
    return out


@njit(cache=True)
def _slips(c, e, row, fy, phase):
    """Theoretical slips and spin of the contact, with what the rig and the tire's making add."""
    angle = row[ALPHA]
    angle += e[E_PLY] * c[PLYSTEER]
    angle += e[E_NONUNIFORM] * c[RUNOUT_ANGLE] * math.sin(phase)
    angle -= e[E_COMPLIANCE] * fy / c[FZ0]
    camber = (c[CAMBER_GAIN] + e[E_CAMBER]) * row[GAMMA] + e[E_PLY] * c[CONICITY]
    spin = math.sin(camber) / c[RADIUS] + e[E_TURN] * row[TURN]
    rolling = max(1.0 + row[KAPPA], 0.05)
    return row[KAPPA] / rolling, math.tan(angle) / rolling, spin


@njit(cache=True)
def _march(c, e, fz, contact, sx, sy, spin, speed, profile):
    """Follow one bristle through the contact: the steady forces and moment."""
    a, kx, ky, mu = contact
    n_bristles = profile.shape[0]
    dx = 2.0 * a / n_bristles
    coupling = min(max(c[COUPLING] + e[E_COUPLING], 0.0), 1.5)
    slip = math.sqrt(sx * sx + sy * sy) * (speed / c[SPEED0]) ** min(e[E_SPEED] * 3.0, 1.0)
    mu_slide = mu * (1.0 - c[SLIDE_DROP] * (1.0 - math.exp(-slip / c[SLIDE_SLIP])))
    q0 = fz / (2.0 * a)
    ux = uy = fx = fy = mz = 0.0
    sliding = False
    for j in range(n_bristles):
        xi = 1.0 - (2.0 * j + 1.0) / n_bristles
        way = dx if j > 0 else 0.5 * dx
        ux += sx * way
        uy += (sy + spin * xi * a) * way
        grip = (mu_slide if sliding else mu) * q0 * profile[j]
        tx, ty, sliding, _, _ = _hold(kx * ux, ky * uy, grip * c[MU_RATIO_X], grip, coupling)
        ux = tx / kx
        uy = ty / ky
        fx += tx * dx
        fy += ty * dx
        mz += ty * xi * a * dx
    return fx, fy, mz


@njit(cache=True)
def _heat(c, row, fx, fy, state, dt):
    """Advance tread and carcass temperature, wear and slid memory by one sample."""
    speed = row[SPEED]
    power = speed * (abs(fy * math.tan(row[ALPHA])) + abs(fx * row[KAPPA]))
    gain = c[HEAT_SHARE] * power + c[ROLLING_HEAT] * row[FZ] * speed
    loss = c[COOLING] + c[COOLING_SPEED] * math.sqrt(speed)
    tread, bulk = state[0], state[1]
    flow = gain - loss * (tread - c[AMBIENT]) - c[BULK_EXCHANGE] * (tread - bulk)
    state[0] = tread + dt * flow / c[HEAT_CAPACITY]
    state[1] = bulk + dt * c[BULK_RATE] * (tread - bulk)
    state[2] += dt * power / c[WEAR_ENERGY]
    slid = min(abs(row[ALPHA]) / 0.1, 1.0)
    state[3] += dt / 4.0 * (slid - state[3])


@njit(cache=True)
def roll_steady(c, e, rows, dt, time0, n_bristles):
    """Forces of a tire that is in steady state at every sample.

    Parameters
    ----------
    c, e : ndarray, shapes (44,), (18,)
        Constants of tire and rig; strengths of the effects.
    rows : ndarray, shape (n, 7)
        slip_angle rad, slip_ratio, camber rad, normal_load N, speed m/s, pressure Pa,
        turn_slip 1/m.
    dt, time0 : float
        Sample period and time of the first sample, s.
    n_bristles : int
        Bristles along the contact.

    Returns
    -------
    ndarray, shape (n, 5)
        fx N, fy N, mz N m, tread temperature degC, wear (1 at the end of the nominal run).
    """
    n = rows.shape[0]
    profile = _profile(c, n_bristles)
    out = np.empty((n, 5))
    state = np.array([c[AMBIENT], c[AMBIENT], 0.0, 0.0])
    rates = np.zeros(2)
    twist = fy = fx = mz = phase = 0.0
    for i in range(n):
        row = rows[i]
        if i > 0:
            rates[0] = abs(row[ALPHA] - rows[i - 1, ALPHA]) / dt
            rates[1] += 0.3 * ((row[FZ] - rows[i - 1, FZ]) / dt - rates[1])
        phase += row[SPEED] / c[RADIUS] * dt
        load = row[FZ] * (1.0 + e[E_NONUNIFORM] * c[RUNOUT_LOAD] * math.sin(phase + c[RUNOUT_PHASE]))
        time = time0 + i * dt
        contact = _contact(c, e, load, row[SPEED], row[PRESSURE], state[0], state[2], state[3], rates, time)
        for _ in range(30):
            sx, sy, spin = _slips(c, e, row, fy + c[COMPLIANCE_FX] * fx, phase)
            fx, fy_new, mz = _march(c, e, load, contact, sx, sy - twist, spin, row[SPEED], profile)
            change = -mz / c[CARCASS_PSI] - twist
            shift = fy_new - fy
            twist += 0.6 * change
            fy += 0.7 * shift
            if abs(change) < 1e-5 and abs(shift) < 0.5:
                break
        fy = fy_new
        _heat(c, row, fx, fy, state, dt)
        out[i, 0], out[i, 1], out[i, 2] = fx, fy, mz
        out[i, 3], out[i, 4] = state[0], state[2]
    return out


@njit(cache=True)
def _step(c, e, load, contact, slips, twist, speed, profile, u, slides, carcass):
    """Carry every bristle one place backwards, deform it, and let the carcass springs follow."""
    a, kx, ky, mu = contact
    n = u.shape[0]
    dx = 2.0 * a / n
    sx, sy, spin = slips
    coupling = min(max(c[COUPLING] + e[E_COUPLING], 0.0), 1.5)
    slip = math.sqrt(sx * sx + sy * sy) * (speed / c[SPEED0]) ** min(e[E_SPEED] * 3.0, 1.0)
    mu_slide = mu * (1.0 - c[SLIDE_DROP] * (1.0 - math.exp(-slip / c[SLIDE_SLIP])))
    q0 = load / (2.0 * a)
    fx = fy = mz = 0.0
    stiff_x = stiff_y = 0.0
    for j in range(n - 1, -1, -1):
        xi = 1.0 - (2.0 * j + 1.0) / n
        ux = u[j - 1, 0] if j > 0 else 0.0
        uy = u[j - 1, 1] if j > 0 else 0.0
        slid = slides[j - 1] if j > 0 else False
        part = 1.0 if j > 0 else 0.5
        ux += part * (sx * dx - carcass[2])
        uy += part * ((sy - twist + spin * xi * a) * dx - carcass[3])
        grip = (mu_slide if slid else mu) * q0 * profile[j]
        tx, ty, slid, left_x, left_y = _hold(kx * ux, ky * uy, grip * c[MU_RATIO_X], grip, coupling)
        u[j, 0] = tx / kx
        u[j, 1] = ty / ky
        slides[j] = slid
        stiff_x += kx * dx * left_x
        stiff_y += ky * dx * left_y
        fx += tx * dx
        fy += ty * dx
        mz += ty * xi * a * dx
    spring_x = c[CARCASS_X] / e[E_RELAXATION]
    spring_y = c[CARCASS_Y] / e[E_RELAXATION]
    carcass[2] = (fx - spring_x * carcass[0]) / (spring_x + stiff_x)
    carcass[3] = (fy - spring_y * carcass[1]) / (spring_y + stiff_y)
    carcass[0] += carcass[2]
    carcass[1] += carcass[3]
    return fx, fy, mz


@njit(cache=True)
def roll_transient(c, e, rows, dt, time0, n_bristles):
    """Forces of a tire whose bristles travel through the contact as the wheel rolls.

    Parameters and result as :func:`roll_steady`. ``e[E_RELAXATION]`` divides the carcass springs:
    1 is the tire as drawn, small values make the carcass rigid.
    """
    n = rows.shape[0]
    profile = _profile(c, n_bristles)
    out = np.empty((n, 5))
    state = np.array([c[AMBIENT], c[AMBIENT], 0.0, 0.0])
    rates = np.zeros(2)
    u = np.zeros((n_bristles, 2))
    slides = np.zeros(n_bristles, dtype=np.bool_)
    carcass = np.zeros(4)
    twist = fy = fx = mz = phase = travelled = 0.0
    row = rows[0].copy()
    for i in range(n):
        if i > 0:
            rates[0] = abs(rows[i, ALPHA] - rows[i - 1, ALPHA]) / dt
            rates[1] += 0.3 * ((rows[i, FZ] - rows[i - 1, FZ]) / dt - rates[1])
        phase += rows[i, SPEED] / c[RADIUS] * dt
        load = rows[i, FZ] * (1.0 + e[E_NONUNIFORM] * c[RUNOUT_LOAD] * math.sin(phase + c[RUNOUT_PHASE]))
        speed = rows[i, SPEED]
        time = time0 + i * dt
        contact = _contact(c, e, load, speed, rows[i, PRESSURE], state[0], state[2], state[3], rates, time)
        travelled += max(speed, 0.2) * max(1.0 + rows[i, KAPPA], 0.05) * dt
        dx = 2.0 * contact[0] / n_bristles
        steps = int(travelled / dx)
        travelled -= steps * dx
        for k in range(steps):
            part = (k + 1.0) / steps
            before = rows[i - 1] if i > 0 else rows[0]
            for m in range(7):
                row[m] = before[m] + part * (rows[i, m] - before[m])
            slips = _slips(c, e, row, fy + c[COMPLIANCE_FX] * fx, phase)
            fx, fy, mz = _step(c, e, load, contact, slips, twist, speed, profile, u, slides, carcass)
            twist += 0.2 * (-mz / c[CARCASS_PSI] - twist)
        _heat(c, rows[i], fx, fy, state, dt)
        out[i, 0], out[i, 1], out[i, 2] = fx, fy, mz
        out[i, 3], out[i, 4] = state[0], state[2]
    return out
