"""Reference values for tests.rs, with 40 digits (needs mpmath; run: python3 creep_references.py).

All parameters are the doubles of the test, taken as exact. The box by exponential integrals, the power
law by incomplete gamma functions, the log-normal spectrum by quadrature of its definition.
"""

from mpmath import mp, mpf, e1, exp, expm1, gammainc, log, pi, quad, sqrt, nstr

mp.dps = 40


def box(shortest, longest, time):
    a, b, t = mpf(shortest), mpf(longest), mpf(time)
    mp.dps = 80
    value = 1 - (e1(t / b) - e1(t / a)) / log(b / a)
    mp.dps = 40
    return value


def power_law(exponent, shortest, longest, time):
    p, a, b, t = mpf(exponent), mpf(shortest), mpf(longest), mpf(time)
    mp.dps = 400
    area = (b**p - a**p) / p
    value = 1 - t**p * (gammainc(-p, t / b) - gammainc(-p, t / a)) / area
    mp.dps = 40
    return value


def log_normal(median, width, time):
    s = mpf(width) * log(mpf(10))
    u = log(mpf(time) / mpf(median))
    integrand = lambda z: exp(-z * z / 2) / sqrt(2 * pi) * -expm1(-exp(u - s * z))
    ends = sorted({mpf(k) / 2 - s for k in range(-40, 41)} | {mpf(k) / 2 for k in range(-40, 41)})
    return quad(integrand, ends)


for name, function, cases in [
    ("LOG_NORMAL", log_normal, [(2e-4, w) for w in (0.01, 0.3, 1.0, 3.0)]),
    ("BOX", box, [(1e-5, 1e-1), (1e-3, 2e-3)]),
    ("POWER_LAW", power_law, [(p, 1e-5, 1e-1) for p in (-30.0, -1.5, 0.3, 1.0, 2.5, 30.0)]),
]:
    print(name)
    for case in cases:
        for time in (1e-12, 1e-6, 1e-4, 3e-3, 1.0):
            values = ", ".join(repr(value) for value in (*case, time))
            print(f"    ([{values}], {nstr(function(*case, time), 20)}),")
