"""Reference solutions of impacts on springs and of loads that are given by formulas.

Judge of tests/it/formulas.rs. Needs mpmath: python3 formulas_reference.py
Writes formulas_reference.csv beside itself. Each line: case, quantity, value, in SI units, 20 digits.

A mass m meets a spring of potential W at the speed V: the deepest place is where W = m V^2 / 2, and the contact
lasts twice the integral of dy / sqrt(V^2 - 2 W / m) up to there. A mass on a linear spring under a load q(t), from
rest, is at x(t) = 1/(m w) * integral of q(s) sin(w (t - s)) ds.
"""

from pathlib import Path

from mpmath import acosh, cosh, exp, log, mp, mpf, nstr, quad, sin, sinh, sqrt, tanh

mp.dps = 60
lines = ["case,quantity,value"]


def give(case, **values):
    lines.extend(f"{case},{name},{nstr(value, 20)}" for name, value in values.items())


def impact(case, m, V, force, potential, deepest):
    y = deepest(m * V**2 / 2)
    assert abs(potential(y) - m * V**2 / 2) < mpf(10) ** -20 * m * V**2
    # With y = Y (1 - u^2) the integrand is smooth where the motion turns.
    rate = lambda u: 2 * y * u / sqrt(V**2 - 2 * potential(y * (1 - u**2)) / m)
    # Where it turns, the difference under the root is rounded: at 60 digits that is far below the 20 written.
    contact = 2 * quad(rate, [0, mpf(1) / 4, mpf(1) / 2, mpf(3) / 4, 1]).real
    give(case, depth=y, force=force(y), contact=contact)


F, a = mpf(2000), mpf("0.005")
impact(
    "tanh",
    mpf(5),
    mpf(4),
    lambda y: F * tanh(y / a),
    lambda y: F * a * log(cosh(y / a)),
    lambda E: a * acosh(exp(E / (F * a))),
)
impact(
    "sinh",
    mpf(5),
    mpf(4),
    lambda y: F * sinh(y / a),
    lambda y: F * a * (cosh(y / a) - 1),
    lambda E: a * acosh(1 + E / (F * a)),
)


def driven(case, m, k, load, cuts, t):
    w = sqrt(k / m)
    give(case, x=quad(lambda s: load(s) * sin(w * (t - s)), cuts) / (m * w))


t = mpf("0.02")
cuts = [t * n / 40 for n in range(41)]
driven("square", mpf(5), mpf(200000), lambda s: 2000 * (s / mpf("0.005")) ** 2, cuts, t)
driven("step", mpf(5), mpf(200000), lambda s: 1000 * (1 + tanh((s - mpf("0.01")) / mpf("0.001"))), cuts, t)
driven("decay", mpf(5), mpf(200000), lambda s: 2000 * (s / mpf("0.003")) * exp(-s / mpf("0.003")), cuts, t)

Path(__file__).with_suffix(".csv").write_text("\n".join(lines) + "\n")
