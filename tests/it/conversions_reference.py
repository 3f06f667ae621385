"""Conversions between equivalent models at 50 digits, from parameters that are exact doubles.

Judge of tests/it/conversions.rs. Needs mpmath: python3 conversions_reference.py
Writes conversions_reference.csv beside itself. Each line: kind, case, inputs, results; numbers within
a field are separated by blanks. Inputs are the shortest decimals of doubles; results have 25 digits.

  two-maxwell   K2 C2 K1 C1 (Burgers) -> K3 C3 K4 C4 (slow, fast)
  burgers       K3 C3 K4 C4 (slow, fast) -> K2 C2 K1 C1, or K2 C2 alone where they are one element
  prony         K_e, then K_j C_j -> J_g phi_0, then K_i C_i of Kelvin elements, fastest first
  tree          the tree in brackets, (s ...) for series, (p ...) for parallel, k... springs, c... dashpots
                -> "maxwell" K_e C, then K_j C_j, "kelvin" J_g phi_0, then K_i C_i, fastest first
"""

import random
from fractions import Fraction
from pathlib import Path

from mpmath import mp, mpf, nstr, polyroots, sqrt

mp.dps = 50
lines = []


def add(kind, case, inputs, results):
    shown = " ".join(own if isinstance(own, str) else nstr(own, 25, min_fixed=1, max_fixed=0) for own in results)
    given = inputs if isinstance(inputs, str) else " ".join(repr(own) for own in inputs)
    lines.append(f"{kind},{case},{given},{shown}")


# Appendix A, with twice the working precision against the cancellation of the printed formulas.


def two_maxwell(constants):
    with mp.workdps(150):
        K2, C2, K1, C1 = map(mpf, constants)
        alpha = (K2 / C2 + K2 / C1 + K1 / C1) / 2
        beta = sqrt(alpha**2 - K1 * K2 / (C1 * C2))
        K3 = K2 * (K1 / C1 - alpha + beta) / (2 * beta)
        K4 = K2 - K3
        return [K3, K3 / (alpha - beta), K4, K4 / (alpha + beta)]


def burgers(constants):
    with mp.workdps(150):
        K3, C3, K4, C4 = map(mpf, constants)
        K2, C2, D = K3 + K4, C3 + C4, C3 * K4 - C4 * K3
        if D == 0:
            return [K2, C2]
        return [K2, C2, K3 * K4 * C2**2 * K2 / D**2, C3 * C4 * K2**2 * C2 / D**2]


# Prony series: zeros of K_e + sum K_j s/(s + r_j) by bisection between its poles, s = -x.


def prony(spring, pairs):
    with mp.workdps(120):
        K_e = mpf(spring)
        elements = sorted(((mpf(K) / mpf(C), mpf(K)) for K, C in pairs), reverse=True)

        def slope(x):
            return sum(K * r / (r - x) ** 2 for r, K in elements)

        def Q(x):
            return K_e - sum(K * x / (r - x) for r, K in elements)

        J_g = 1 / (K_e + sum(K for _, K in elements))
        fluidity = 0 if K_e else 1 / sum(K / r for r, K in elements)
        results = [J_g, fluidity]
        ends = [r for r, _ in elements] + ([mpf(0)] if K_e else [])
        for high, low in zip(ends, ends[1:]):
            # Q falls from infinity, just above the lower pole, to minus infinity.
            for _ in range(380):
                middle = (low + high) / 2
                if Q(middle) > 0:
                    low = middle
                else:
                    high = middle
            z = (low + high) / 2
            # 1/Q(s) has at s = -z the strength 1/Q'(s) = 1/slope.
            results += [z * slope(z), slope(z)]
        return results


# Trees: the relaxance as a quotient of two polynomials in s with rational coefficients.


def plus(p, q):
    size = max(len(p), len(q))
    return trimmed([(p[k] if k < len(p) else 0) + (q[k] if k < len(q) else 0) for k in range(size)])


def times(p, q):
    product = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] += a * b
    return trimmed(product)


def trimmed(p):
    while len(p) > 1 and p[-1] == 0:
        p = p[:-1]
    return p


def divided(p, q):
    """Quotient and remainder."""
    rest, quotient = list(p), [Fraction(0)] * max(1, len(p) - len(q) + 1)
    for shift in range(len(p) - len(q), -1, -1):
        quotient[shift] = rest[shift + len(q) - 1] / q[-1]
        for k, own in enumerate(q):
            rest[shift + k] -= quotient[shift] * own
    return trimmed(quotient), trimmed(rest[: max(1, len(q) - 1)])


def reduced(p, q):
    a, b = p, q
    while b != [0]:
        b = [own / b[-1] for own in b]
        a, b = b, (divided(a, b)[1] if len(a) >= len(b) else a)
    return (divided(p, a)[0], divided(q, a)[0]) if len(a) > 1 else (p, q)


def relaxance(tree):
    word, *rest = tree
    if word == "k":
        return [Fraction(rest[0])], [Fraction(1)]
    if word == "c":
        return [Fraction(0), Fraction(rest[0])], [Fraction(1)]
    total = None
    for n, d in map(relaxance, rest):
        if word == "s":
            n, d = d, n
        total = (n, d) if total is None else reduced(plus(times(total[0], d), times(n, total[1])), times(total[1], d))
    return total if word == "p" else total[::-1]


def polynomial(p, x):
    value = mpf(0)
    for own in reversed(p):
        value = value * x + mpf(own.numerator) / own.denominator
    return value


def derivative(p):
    return [k * own for k, own in enumerate(p)][1:] or [Fraction(0)]


def roots(p):
    """Rates x > 0 at which p(-x) = 0, fastest first; a root at zero is left out."""
    while p[0] == 0:
        p = p[1:]
    if len(p) == 1:
        return []
    found = polyroots([mpf(own.numerator) / own.denominator for own in reversed(p)], maxsteps=2000, extraprec=4000)
    assert all(abs(own.imag) <= abs(own) * mpf(10) ** -60 and own.real < 0 for own in found)
    return sorted((-own.real for own in found), reverse=True)


def fraction(own):
    return mpf(own.numerator) / own.denominator


def forms(tree):
    with mp.workdps(150):
        n, d = relaxance(tree)
        is_solid = n[0] != 0
        has_dashpot = len(n) > len(d)
        maxwell = [fraction(n[0] / d[0]) if is_solid else 0, fraction(n[-1] / d[-1]) if has_dashpot else 0]
        for r in roots(d):
            # Q/s has at s = -r the strength K_j.
            K = polynomial(n, -r) / (-r) / polynomial(derivative(d), -r)
            maxwell += [K, K / r]
        # 1/Q = d/n; a zero of n at s = 0 is the single dashpot's.
        kelvin = [0 if has_dashpot else fraction(d[-1] / n[-1]), 0 if is_solid else fraction(d[0] / n[1])]
        for z in roots(n):
            strength = polynomial(d, -z) / polynomial(derivative(n), -z)
            kelvin += [z / strength, 1 / strength]
        assert all(own >= 0 for own in maxwell + kelvin)
        return ["maxwell", *maxwell, "kelvin", *kelvin]


def shown(tree):
    word, *rest = tree
    if word in "kc":
        return word + repr(rest[0])
    return "(" + " ".join([word, *map(shown, rest)]) + ")"


def grown(dice, depth, word):
    """A tree of the given depth in which series and parallel alternate."""
    if depth == 0:
        return [dice.choice("kc"), decades(dice)]
    other = "p" if word == "s" else "s"
    branches = [grown(dice, depth - 1, other)]
    for _ in range(dice.randint(1, 2)):
        branches.append(grown(dice, dice.randint(0, depth - 1) if depth < 4 else 1, other))
    return [word, *branches]


def decades(dice):
    """Log-uniform over 12 decades, with few digits, so that the table is short and the double is not."""
    return float(f"{10 ** dice.uniform(-6, 6):.9e}")


dice = random.Random(20)
base = [20e6, 6000.0, 20e6, 4000.0]
add("two-maxwell", "reference", base, two_maxwell(base))
base = [8e6, 12000.0, 12e6, 900.0]
add("burgers", "reference", base, burgers(base))
for at in range(200):
    own = [decades(dice) for _ in range(4)]
    add("two-maxwell", f"random-{at}", own, two_maxwell(own))
    own = [decades(dice) for _ in range(4)]
    add("burgers", f"random-{at}", own, burgers(own))

# Two elements whose rates differ by 10^-k, in slow, fast order.
for power in range(2, 15):
    own = [3e6, 4.5e3, 7e6, 7e6 * (4.5e3 / 3e6) * (1 - 10.0**-power)]
    add("burgers", f"distance-{power}", own, burgers(own))
for at, own in enumerate([[3e6, 6e3, 1e6, 2e3], [0.1, 0.3, 0.2, 0.6], [1.0, 1.0, 1.0, 1.0]]):
    add("burgers", f"singular-{at}", own, burgers(own))

# Nearly equal rates of the Maxwell elements: b small against a and c, which are (nearly) equal.
for power in (2, 6, 10, 14, 18):
    for at, stretch in enumerate((1.0, 1 + 2.0**-40, 1 - 2.0**-20)):
        own = [3.0, 0.7, 3.0 * 10.0**power * stretch, 0.7 * 10.0**power]
        add("two-maxwell", f"coinciding-{power}-{at}", own, two_maxwell(own))

weights = [180.0, 230.0, 300.0, 350.0, 380.0, 300.0, 180.0, 60.0, 12.0, 3.0, 1.1]
glassy = [(weight * 1e6, weight * 1e6 * 10.0 ** (at - 5)) for at, weight in enumerate(weights)]
falling, rugged = [], []
for at in range(60):
    time = float(f"{10 ** (-12 + 24 * at / 59):.6e}")
    weight = float(f"{10 ** (7.5 - 15 * at / 59):.6e}")
    falling.append((weight, weight * time))
    weight = float(f"{10 ** (7.5 * (1 if at * 37 % 59 < 30 else -1)):.6e}")
    rugged.append((weight, weight * time))
for name, spring, pairs in (
    ("glassy", 2.2e6, glassy),
    ("glassy-liquid", 0.0, glassy),
    ("falling", 1e-7, falling),
    ("rugged", 1e-7, rugged),
    ("rugged-liquid", 0.0, rugged),
):
    add("prony", name, [spring, *(own for pair in pairs for own in pair)], prony(spring, pairs))

for at in range(12):
    tree = grown(dice, 4, "sp"[at % 2])
    add("tree", f"depth-4-{at}", shown(tree), forms(tree))

header = "kind,case,inputs,results"
Path(__file__).with_suffix(".csv").write_text("\n".join([header, *lines]) + "\n")
