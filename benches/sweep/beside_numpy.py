"""Times `dashpot.sweep` beside NumPy and scipy by hand on 10 000 scenes: the reference impact over two numbers of its pad.

All report the peak force and the peak deformation of the padding. By hand there are
- NumPy's eigenvalues of all matrices at once, peaks on a grid of times and then by Newton's method: the best that is
  known by hand, for linear scenes alone;
- scipy's exponentials of all matrices at once, and as many steps as a grid has times;
- scipy's `solve_ivp` for scene after scene, of which it does a hundredth that is scaled up.
dashpot's points bring their errors; those by hand bring none. Times are those of the processor, user and system, on any
number of threads; medians of five.

    pip install . scipy
    OPENBLAS_NUM_THREADS=1 python benches/sweep/beside_numpy.py
"""

import statistics
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import dashpot

SIDE, END, GRID, RUNS = 100, 0.02, 400, 5
MASS, PANEL, SPEED, KELVIN_SPRING, MAXWELL_DASHPOT, MOUNT = 10.0, 100.0, 10.0, 20e6, 6e3, (50e6, 10e3)
SPRINGS, DASHPOTS = np.geomspace(5e6, 80e6, SIDE), np.geomspace(1e3, 16e3, SIDE)
MEASURES = ("padding.peak-force", "padding.peak-deformation")


def matrices(spring, dashpot_):
    """Those of x, v of the head and the panel, of the dashpot in series and of the Kelvin element."""
    spring, dashpot_ = np.broadcast_arrays(spring, dashpot_)
    one = np.ones_like(spring)
    # The force is that of the spring in series: k (x - X - z - u).
    force = np.stack([spring, 0 * one, -spring, 0 * one, -spring, -spring], -1)
    all = np.zeros((*spring.shape, 6, 6))
    all[..., 0, 1] = all[..., 2, 3] = 1
    all[..., 1, :] = -force / MASS
    all[..., 3, :] = force / PANEL
    all[..., 3, 2] -= MOUNT[0] / PANEL
    all[..., 3, 3] -= MOUNT[1] / PANEL
    all[..., 4, :] = force / MAXWELL_DASHPOT
    all[..., 5, :] = force / dashpot_[..., None]
    all[..., 5, 5] -= KELVIN_SPRING / dashpot_
    return all, force


OUTPUT = np.array([1.0, 0, -1, 0, 0, 0])
START = np.array([0, SPEED, 0, 0, 0, 0])


def by_modes(all, force):
    rates, modes = np.linalg.eig(all)
    start = np.linalg.solve(modes, np.broadcast_to(START, rates.shape)[..., None].astype(complex))[..., 0]
    times = np.linspace(0, END, GRID + 1)
    found = []
    for row in (force, np.broadcast_to(OUTPUT, force.shape)):
        weights = np.einsum("...i,...ij->...j", row, modes) * start
        # A few hundred scenes at once stay in the cache.
        best = np.concatenate([
            times[np.einsum("sj,sjt->st", w, np.exp(r[:, :, None] * times)).real.argmax(-1)]
            for r, w in zip(np.array_split(rates, 100), np.array_split(weights, 100))
        ])
        for _ in range(4):
            now = weights * np.exp(rates * best[:, None])
            slope, bend = (now * rates).sum(-1).real, (now * rates**2).sum(-1).real
            best = np.clip(best - slope / np.where(bend < 0, bend, -np.inf), 0, END)
        found.append((weights * np.exp(rates * best[:, None])).sum(-1).real)
    return found


def by_exponentials(all, force):
    step = expm(all * (END / GRID))
    state = np.repeat(START[None, :, None], len(all), 0).astype(float)
    force, track = force[:, None, :], []
    for _ in range(GRID):
        state = step @ state
        track.append((np.squeeze(force @ state), state[:, 0, 0] - state[:, 2, 0]))
    track = np.array(track)
    return [vertex(track[:, 0]), vertex(track[:, 1])]


def vertex(values):
    """The highest value, by the parabola through it and its neighbours."""
    at = np.clip(values.argmax(0), 1, len(values) - 2)
    low, mid, high = (np.take_along_axis(values, (at + by)[None], 0)[0] for by in (-1, 0, 1))
    bend = low - 2 * mid + high
    return np.where(bend < 0, mid - (high - low) ** 2 / (8 * np.where(bend < 0, bend, 1)), mid)


def one_by_one(all, force):
    found = []
    for matrix, row in zip(all, force):
        solved = solve_ivp(lambda t, y, a=matrix: a @ y, (0, END), START, "DOP853", dense_output=True, rtol=1e-7, atol=1e-12)
        states = solved.sol(np.linspace(0, END, GRID + 1))
        found.append([vertex((row @ states)[:, None])[0], vertex((OUTPUT @ states)[:, None])[0]])
    return np.array(found).T


def timed(call, runs=RUNS):
    took = []
    for _ in range(runs):
        start = time.process_time()
        found = call()
        took.append(time.process_time() - start)
    return statistics.median(took), found


def main():
    vary = {"padding.maxwell.spring": SPRINGS, "padding.kelvin.dashpot": DASHPOTS}
    spring, dashpot_ = (own.ravel() for own in np.meshgrid(SPRINGS, DASHPOTS, indexing="ij"))
    all, force = matrices(spring, dashpot_)
    ours, swept = timed(lambda: dashpot.sweep("reference", vary, MEASURES))
    plain, _ = timed(lambda: dashpot.sweep("reference", vary, MEASURES, estimate="off"))
    own = [swept[key].ravel() for key in MEASURES]
    print(f"{'':36}{'CPU':>10}{'ratio':>8}  differs by (peak force, deformation)")
    print(f"{'dashpot.sweep, with errors':36}{ours * 1e3:7.0f} ms{1:8.2f}")
    print(f"{'dashpot.sweep, estimate=off':36}{plain * 1e3:7.0f} ms{plain / ours:8.2f}")
    few = slice(None, None, 100)
    rivals = {
        "NumPy, modes and Newton": (by_modes, 1, slice(None)),
        "scipy, exponentials and steps": (by_exponentials, 1, slice(None)),
        "scipy, solve_ivp (1 of 100, scaled)": (one_by_one, 100, few),
    }
    for name, (call, scale, part) in rivals.items():
        took, found = timed(lambda: call(all[part], force[part]), RUNS if scale == 1 else 1)
        apart = [np.abs(one / other[part] - 1).max() for one, other in zip(found, own)]
        words = ", ".join(f"{one:.1e}" for one in apart)
        print(f"{name:36}{took * scale * 1e3:7.0f} ms{took * scale / ours:8.2f}  {words}")


if __name__ == "__main__":
    main()
