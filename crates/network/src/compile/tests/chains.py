"""Reference values for chains.rs, with 150 digits (needs mpmath; run: python3 chains.py).

Displacement of a mass of 1e6 kg that strikes a chain of Kelvin-Voigt elements at 1 m/s, from the
poles of m s^2 + 1/J(s). The constants are built from doubles, exactly as the tests build them.
"""

from mpmath import exp, mp, mpf, polyroots, re

mp.dps = 150


def chain(front, count, decades, even):
    terms = [([1], [mpf(f)]) if kind == "spring" else ([1], [0, mpf(f)]) for kind, f in front]
    for i in range(count):
        stiffness = 1e6 * float(1 + (7 * i) % 5) if even else 1e6 * float("1e%d" % ((5 * i) % 4))
        exponent = -(decades // 2) + decades * i // (count - 1)
        damping = stiffness * float("1e%d" % exponent) * float(1 + i % 3)
        terms.append(([1], [mpf(stiffness), mpf(damping)]))
    return terms


def times(a, b):
    product = [mpf(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            product[i + j] += x * y
    return product


def plus(a, b):
    length = max(len(a), len(b))
    a, b = (form + [mpf(0)] * (length - len(form)) for form in (a, b))
    return [x + y for x, y in zip(a, b)]


def at(form, s):
    value = mpf(0)
    for coefficient in reversed(form):
        value = value * s + coefficient
    return value


def impact(mass, terms, instants):
    compliance, common = [mpf(0)], [mpf(1)]
    for over, under in terms:
        compliance = plus(times(compliance, under), times(over, common))
        common = times(common, under)
    over = times([mpf(mass)], compliance)
    under = plus(times([0, 0, mpf(mass)], compliance), common)
    while over[0] == 0 and under[0] == 0:
        over, under = over[1:], under[1:]
    while under[-1] == 0:
        under.pop()
    rest = under[0] == 0
    roots = polyroots(list(reversed(under[1:] if rest else under)), maxsteps=2000, extraprec=600)
    slope = [i * c for i, c in enumerate(under)][1:]
    for t in instants:
        value = sum(re(at(over, r) / at(slope, r) * exp(r * mpf(t))) for r in roots)
        print("   ", t, mp.nstr(value + (over[0] / under[1] if rest else 0), 18))


INSTANTS = [1e-3, 1.0, 10.0, 100.0, 1e4]
SPRING, DASHPOT = ("spring", 3e6), ("dashpot", 7e6)
for name, front in [("elements", []), ("spring", [SPRING]), ("both", [SPRING, DASHPOT])]:
    for count, decades, even in [(4, 6, True), (8, 12, False), (12, 13, True)]:
        print(name, count, decades, even)
        impact(1e6, chain(front, count, decades, even), INSTANTS)
