"""Makes the records of docs/fit.md and docs/cannot-tell.md: a gel of three modes in oscillation, three drops on a pad, one
through a filter, the pad pressed and let go of, and a hold after a ramp.

The pad is a Zener element of 30 kN/m, 60 kN/m and 200 N s/m under 4 kg; its equations are integrated here by the classical
Runge-Kutta method, until the force falls to zero. Noise has a fixed seed.
"""

import math
import random

stream = random.Random(11)


def gel():
    modes = [(0.4e-3, 3.0), (4e-3, 2.0), (60e-3, 1.2)]
    rows = ["f,E',E''", "Hz,MPa,MPa"]
    for step in range(37):
        frequency = 10 ** (-0.5 + step / 9)
        omega = 2 * math.pi * frequency
        storage, loss = 2.0, 0.0
        for time, modulus in modes:
            x = omega * time
            storage += modulus * x * x / (1 + x * x)
            loss += modulus * x / (1 + x * x)
        noise = [1 + 0.005 * stream.gauss(0, 1) for _ in range(2)]
        rows.append(f"{frequency:.5g},{storage * noise[0]:.5g},{loss * noise[1]:.5g}")
    return rows


def filtered(values, cfc, rate):
    """Through CFC of SAE J211-1, forward and backward, with the record turned about its ends."""
    wa = math.tan(math.pi * 2.0775 * cfc / rate)
    whole = 1 + math.sqrt(2) * wa + wa * wa
    a, b1, b2 = wa * wa / whole, 2 * (1 - wa * wa) / whole, (math.sqrt(2) * wa - 1 - wa * wa) / whole
    beyond = min(len(values) - 1, math.ceil(7 * rate / (2.0775 * cfc)))
    before = [2 * values[0] - own for own in values[beyond:0:-1]]
    behind = [2 * values[-1] - own for own in values[-2 : -2 - beyond : -1]]
    all = before + values + behind
    for _ in range(2):
        x1 = x2 = y1 = y2 = all[0]
        for at, x in enumerate(all):
            y = a * (x + 2 * x1 + x2) + b1 * y1 + b2 * y2
            x2, x1, y2, y1 = x1, x, y1, y
            all[at] = y
        all.reverse()
    return all[beyond : beyond + len(values)]


def drop(speed, late, zero, count=360, cfc=None):
    mass, spring, branch, dashpot = 4.0, 30e3, 60e3, 200.0

    def rates(state):
        depth, velocity, force = state
        return (velocity, -(spring * depth + force) / mass, branch * velocity - branch / dashpot * force)

    step, every = 1e-6, 100
    state, forces, time = (0.0, speed, 0.0), [], 0.0
    for at in range(40_001):
        total = spring * state[0] + state[2]
        if at > 10 and total <= 0:
            break
        if at % every == 0:
            forces.append(total)
        k1 = rates(state)
        k2 = rates([s + step / 2 * k for s, k in zip(state, k1)])
        k3 = rates([s + step / 2 * k for s, k in zip(state, k2)])
        k4 = rates([s + step * k for s, k in zip(state, k3)])
        state = [s + step / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4)]
    before = round(late * 1e4)
    readings = []
    for at in range(count):
        index = at - before
        force = forces[index] if 0 <= index < len(forces) else 0.0
        readings.append(force / mass / 9.80665 + zero + 0.3 * stream.gauss(0, 1))
    if cfc:
        readings = filtered(readings, cfc, 1e4)
    return ["t [ms],acc [g]"] + [f"{at / 10:.1f},{own:.3f}" for at, own in enumerate(readings)]


def pressed():
    """Force over deformation at 10 mm/min, at which the branch has relaxed: 30 kN/m, with noise of 2 N."""
    ways = [15 * at / 40 for at in range(41)]
    rows = [(way, 30 * way + 2 * stream.gauss(0, 1)) for way in ways + ways[-2::-1]]
    return ["way [mm],force [N]"] + [f"{way:.3f},{force:.2f}" for way, force in rows]


def hold():
    """A strain that rises to 10 % within 0.5 s and is held; the stress of a foam, to half a percent."""
    ramp, strain, modes = 0.5, 0.1, [(5e-3, 600.0), (12.0, 300.0)]
    rows = ["t [s],strain [%],stress [kPa]"]
    times = [0.05 * at for at in range(61)] + [3 + 0.5 * at for at in range(1, 115)]
    for time in times:
        loaded = min(time, ramp)
        stress = 400.0 * strain * loaded / ramp
        for relaxation, modulus in modes:
            grown = modulus * relaxation * strain / ramp * -math.expm1(-loaded / relaxation)
            stress += grown * math.exp(-max(time - ramp, 0.0) / relaxation)
        stress += 0.3 * stream.gauss(0, 1)
        rows.append(f"{time:.2f},{100 * strain * loaded / ramp:.3f},{stress:.2f}")
    return rows


records = [("dma", gel()), ("low", drop(2.0, 2.0e-3, 0.7)), ("high", drop(3.2, 3.1e-3, -0.4))]
stream = random.Random(60)
records.append(("class60", drop(3.25, 20.4e-3, 0.5, 600, 60)))
stream = random.Random(7)
records.append(("pressed", pressed()))
stream = random.Random(5)
records.append(("hold", hold()))
for name, rows in records:
    with open(f"{name}.csv", "w") as file:
        file.write("\n".join(rows) + "\n")
