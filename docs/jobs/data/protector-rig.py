"""Makes the records of docs/jobs/protector.md: a flat plate of 5 kg at 3, 4 and 4.5 m/s on a block of foam, 20 mm thick with
14 cm2, by its force over time.

The foam is that of Avalle, Belingardi and Ibba with 8 MPa, 1.6 MPa and 0.5 MPa; its equation of motion is integrated by the
classical Runge-Kutta method. Noise of 20 N, the zero of the load cell and the clock have a fixed seed.
"""

import math
import random

stream = random.Random(3)


def stress(strain):
    return 1.6e6 * (1 - math.exp(-8e6 * strain / 1.6e6)) + 0.5e6 * (strain / (1 - strain)) ** 2


def record(speed):
    mass, thickness, area, step, every = 5.0, 20e-3, 14e-4, 1e-6, 50

    def rates(state):
        return (state[1], -area * stress(max(state[0], 0.0) / thickness) / mass)

    state, forces, at = (0.0, speed), [], 0
    while state[0] >= 0:
        if at % every == 0:
            forces.append(area * stress(state[0] / thickness))
        k1 = rates(state)
        k2 = rates([s + step / 2 * k for s, k in zip(state, k1)])
        k3 = rates([s + step / 2 * k for s, k in zip(state, k2)])
        k4 = rates([s + step * k for s, k in zip(state, k3)])
        state = [s + step / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4)]
        at += 1
    zero, before = stream.gauss(0, 15), 40
    rows = ["t [ms],F [N]"]
    for at in range(320):
        index = at - before
        force = forces[index] if 0 <= index < len(forces) else 0.0
        rows.append(f"{at / 20:.2f},{force + zero + stream.gauss(0, 20):.1f}")
    return rows


for speed, name in [(3.0, "rig-slow"), (4.0, "rig-middle"), (4.5, "rig-fast")]:
    with open(f"protector-{name}.csv", "w", encoding="utf-8") as file:
        file.write("\n".join(record(speed)) + "\n")
