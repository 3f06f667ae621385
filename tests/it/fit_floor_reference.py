"""Random records of linear materials, and how near the nearest of all networks comes to each: nonnegative least squares
by scipy on a fine grid of times, refined around those that are taken, down to times that no row resolves.

    python3 fit_floor_reference.py              writes fit_floor_reference.csv (3 records of each kind)
    python3 fit_floor_reference.py DASHPOT 60   fits 60 records of each kind with that command and compares its floor
"""
import csv, json, pathlib, subprocess, sys, tempfile

import numpy as np
from scipy.optimize import nnls

KINDS = {"relaxation": ("t [s]", "G [Pa]"), "creep": ("t [s]", "J [1/Pa]"), "oscillation": ("f [Hz]", "E' [Pa]", "E'' [Pa]")}
TO = {"relaxation": "G", "creep": "J", "oscillation": "E',E''"}

def blocks(kind, x, tau):
    """Rows of branches of unit strength, each column times what makes it finite; spring and dashpot last."""
    x, one = x[:, None], np.ones((len(x), 1))
    if kind == "relaxation":
        # What is lost before the first row changes a strength alone.
        return [np.hstack([np.exp(-(x - x[0]) / tau), one])]
    if kind == "creep":
        return [np.hstack([-np.expm1(-x / tau), one, x])]
    w = 2 * np.pi * x * tau
    zero = 0 * one
    return [np.hstack([w**2 / (1 + w**2), one, zero]), np.hstack([w / (1 + w**2), zero, 2 * np.pi * x])]

def record(kind, seed):
    r = np.random.default_rng([list(KINDS).index(kind), seed])
    rows = int(r.integers(15, 60))
    low = 10 ** r.uniform(-4, 1)
    x = np.geomspace(low, low * 10 ** r.uniform(2, 5), rows)
    window = np.log(x if kind != "oscillation" else 1 / (2 * np.pi * x))
    count = int(r.integers(1, 6))
    tau = np.exp(r.uniform(window.min() - 2, window.max() + 2, count))
    strength = 10 ** r.normal(0, 0.5, count)
    spring = r.choice([0, 1]) * 10 ** r.normal(0, 0.5) + 0.05
    flow = r.choice([0, 0, 1]) * 10 ** r.normal(0, 0.5)
    if kind == "relaxation":
        values = [spring + np.exp(-x[:, None] / tau) @ strength]
    elif kind == "creep":
        values = [spring + -np.expm1(-x[:, None] / tau) @ strength + flow * x / x.max()]
    else:
        w = 2 * np.pi * x[:, None] * tau
        values = [spring + w**2 / (1 + w**2) @ strength, w / (1 + w**2) @ strength + flow * x / x.max()]
    noise = 10 ** r.uniform(-2.5, -1.5)
    size = 1e-6 if kind == "creep" else 1e6
    values = [size * v * (1 + noise * r.standard_normal(rows)) for v in values]
    round6 = lambda all: np.array([float(f"{v:.6g}") for v in all])
    return round6(x), [round6(v) for v in values]

def nearest(kind, x, values):
    """Root of the mean square, in parts of each row, that the nearest network leaves."""
    times = x if kind != "oscillation" else 1 / (2 * np.pi * x)
    tau = np.geomspace(times.min() / 1e3, times.max() * 1e3, 500)
    best = np.inf
    for _ in range(7):
        a = np.vstack([b / v[:, None] for b, v in zip(blocks(kind, x, tau), values)])
        length = np.linalg.norm(a, axis=0)
        a /= np.where(length > 0, length, 1)
        found, _ = nnls(a, np.ones(len(a)), maxiter=200000)
        # Where columns are nearly alike the residual that it returns may be wrong.
        best = min(best, np.linalg.norm(a @ found - 1) / len(a) ** 0.5)
        taken = np.flatnonzero(found[: len(tau)] > 0)
        near = [np.geomspace(tau[max(k - 1, 0)], tau[min(k + 1, len(tau) - 1)], 25) for k in taken]
        tau = np.unique(np.concatenate([tau[::25], *near]))
    return best

def text(kind, x, values):
    rows = "".join(",".join(f"{v:.6g}" for v in row) + "\n" for row in zip(x, *values))
    return ",".join(KINDS[kind]) + "\n" + rows

def compare(command, count):
    for kind in KINDS:
        parts = []
        for seed in range(count):
            x, values = record(kind, seed)
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "record.csv"
                file.write_text(text(kind, x, values))
                arguments = [command, "fit", "--to", f"{file}:{TO[kind]}=felt", "--json", *sys.argv[3:]]
                done = subprocess.run(arguments, capture_output=True, text=True, timeout=60)
            if done.returncode:
                print(kind, seed, done.stderr)
                continue
            parts.append((json.loads(done.stdout)["floor"] / nearest(kind, x, values), seed))
        parts.sort()
        above = [p for p in parts if p[0] > 1 + 1e-9]
        print(f"{kind}: {len(parts)} records; floor over nearest: least {parts[0][0]:.5f} (seed {parts[0][1]}), "
              f"median {parts[len(parts) // 2][0]:.6f}, most {parts[-1][0]:.6f}; above it in {len(above)}")

if __name__ == "__main__":
    if len(sys.argv) > 2:
        compare(sys.argv[1], int(sys.argv[2]))
    else:
        here = pathlib.Path(__file__).with_suffix(".csv")
        with here.open("w", newline="") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(["kind", "nearest", "at", "first", "second"])
            for kind in KINDS:
                for seed in range(3):
                    x, values = record(kind, seed)
                    best = f"{nearest(kind, x, values):.12g}"
                    for row in zip(x, *values):
                        out.writerow([f"{kind}-{seed}", best, *(f"{v:.6g}" for v in row)] + [""] * (2 - len(values)))
