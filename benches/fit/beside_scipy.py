"""Times `dashpot fit` beside scipy's least_squares on the same residuals.

A mass strikes a Zener pad; 400 samples of its acceleration at 20 kHz, with noise, clock and zero off. Both search the
same five unknowns, logarithms of three numbers among them, from the same start within the same bounds, by a trust
region with differences. scipy's model is the modal form, at all samples at once; dashpot's time is that of the whole
command: scene and record are read, full runs compared with the fast ones, and measures are given their bands. Times are
those of the processor, user and system, which others on the machine change little; medians of eleven.

    pip install numpy scipy
    OPENBLAS_NUM_THREADS=1 python3 benches/fit/beside_scipy.py target/release/dashpot
"""

import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import least_squares

RATE, COUNT, NOISE = 2e4, 400, 4.9
RUNS = 11
MASS, SPEED, TRUTH = 4.0, 3.0, np.array([200e3, 300e3, 500.0])
LOW, HIGH, START = TRUTH / 20, TRUTH * 20, TRUTH * np.array([2.0, 0.5, 2.0])
SCENE = """
[values]
K = "{0:.0f} N/m"
K1 = "{1:.0f} N/m"
C1 = "{2:.0f} N s/m"
[nodes]
head = {{ mass = "4 kg", velocity = "3 m/s" }}
[elements]
pad = {{ between = ["head", "ground"], zener = {{ spring = "K", maxwell = {{ spring = "K1", dashpot = "C1" }} }} }}
[effects]
separation.pad = {{ at = "head" }}
[run]
duration = "30 ms"
"""


def model(unknowns, times):
    k, k1, c1 = np.exp(unknowns[:3])
    matrix = np.array([[0, 1, 0], [-k / MASS, 0, -1 / MASS], [0, k1, -k1 / c1]])
    rates, modes = np.linalg.eig(matrix)
    weights = (np.array([k, 0, 1]) / MASS) @ modes * np.linalg.solve(modes, np.array([0.0, SPEED, 0.0]))
    force = lambda t: (np.exp(np.multiply.outer(t, rates)) @ weights).real
    late = times - unknowns[3] * times[-1]
    values = np.where(late > 0, force(np.maximum(late, 0)), 0)
    # Behind the release there is nothing; it lies between the first sample that pulls and the one before.
    pulls = np.flatnonzero((values < 0) & (late > 0))
    if len(pulls):
        values[pulls[0] :] = 0
    return values + unknowns[4] * 700


def timed(call, who):
    """What a call returns, and the median of its time on the processor."""
    times = []
    for _ in range(RUNS):
        before = resource.getrusage(who)
        found = call()
        after = resource.getrusage(who)
        times.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
    return found, statistics.median(times)


def main(command):
    times = np.arange(COUNT) / RATE
    truth = np.concatenate([np.log(TRUTH), [0.0021 / times[-1], 0.01]])
    measured = model(truth, times) + NOISE * np.random.default_rng(1).normal(size=COUNT)
    peak = np.abs(measured).max()
    residual = lambda unknowns: (model(unknowns, times) - measured) / peak
    start = np.concatenate([np.log(START), [0.0, 0.0]])
    bounds = np.concatenate([np.log(LOW), [-2, -1]]), np.concatenate([np.log(HIGH), [2, 1]])
    def search():
        return least_squares(residual, start, jac="3-point", bounds=bounds, x_scale="jac")

    found, scipy_time = timed(search, resource.RUSAGE_SELF)
    print("scipy  ", np.exp(found.x[:3]), f"{1e3 * scipy_time:.1f} ms, {found.nfev} steps")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "pad.toml").write_text(SCENE.format(*START))
        rows = "\n".join(f"{t:.6e},{a:.9e}" for t, a in zip(times, measured))
        (folder / "drop.csv").write_text("t [s],acc [m/s^2]\n" + rows + "\n")
        vary = [f"{n}={a:.6g}..{b:.6g} {u}" for n, a, b, u in zip(("K", "K1", "C1"), LOW, HIGH, ("N/m", "N/m", "N s/m"))]
        arguments = [command, "fit", "pad.toml", "--to", "drop.csv:acc=head.acceleration", "--json"]
        arguments += ["--starts", "1", "--robust", "off"] + sum((["--vary", own] for own in vary), [])

        def command_alone():
            return subprocess.run(arguments, cwd=folder, capture_output=True, check=True)

        answer, own_time = timed(command_alone, resource.RUSAGE_CHILDREN)
        own = json.loads(answer.stdout)["parameters"]
        print("dashpot", np.array([own[name]["value"] for name in ("K", "K1", "C1")]), f"{1e3 * own_time:.1f} ms")
        print(f"ratio {scipy_time / own_time:.1f}, load {os.getloadavg()[0]:.1f}")


main(str(pathlib.Path(sys.argv[1]).resolve()))
