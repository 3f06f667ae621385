"""Reference values for reference.rs (needs mpmath; run: python3 many_digits.py).

The receptance is a quotient of determinants. Both are found as polynomials in exact rational
arithmetic from the doubles that the tests use, common factors are divided out exactly, and the
zeros of what is left are computed with 120 digits.
"""

from fractions import Fraction

from mpmath import mp, mpf, polyroots, polyval

mp.dps = 120


def determinant(rows):
    rows = [row[:] for row in rows]
    size, value = len(rows), Fraction(1)
    for at in range(size):
        pivot = next((row for row in range(at, size) if rows[row][at] != 0), None)
        if pivot is None:
            return Fraction(0)
        if pivot != at:
            rows[at], rows[pivot], value = rows[pivot], rows[at], -value
        value *= rows[at][at]
        for row in range(at + 1, size):
            factor = rows[row][at] / rows[at][at]
            if factor:
                rows[row] = [x - factor * y for x, y in zip(rows[row], rows[at])]
    return value


def trim(p):
    while p and p[-1] == 0:
        p = p[:-1]
    return p


def multiply(p, q):
    out = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            out[i + j] += x * y
    return out


def divide(p, q):
    p, out = p[:], [Fraction(0)] * max(len(p) - len(q) + 1, 0)
    while len(p) >= len(q):
        factor = p[-1] / q[-1]
        out[len(p) - len(q)] = factor
        for i, y in enumerate(q):
            p[len(p) - len(q) + i] -= factor * y
        p = p[:-1]
    return out, trim(p)


def interpolate(values):
    """The polynomial with values[n] at n, by Newton's differences."""
    table, out, base = values[:], [Fraction(0)], [Fraction(1)]
    for order in range(len(values)):
        term = [c * table[0] for c in base]
        out = [a + b for a, b in zip(out + [0] * len(term), term + [0] * len(out))]
        table = [(b - a) / (order + 1) for a, b in zip(table, table[1:])]
        base = multiply(base, [Fraction(-order), Fraction(1)])
    return trim(out)


def receptance(name, masses, springs, dashpots, a, b):
    """Node 0 is held; `masses` are those of the nodes 1, 2, …"""
    count = len(masses)

    def bordered(s, with_pair):
        size = count + with_pair
        rows = [[Fraction(0)] * size for _ in range(size)]
        for links, power in ((springs, 0), (dashpots, 1)):
            for p, q, value in links:
                value = Fraction(value) * s**power
                for x, y, sign in ((p, p, 1), (q, q, 1), (p, q, -1), (q, p, -1)):
                    if x and y:
                        rows[x - 1][y - 1] += sign * value
        for at, mass in enumerate(masses):
            rows[at][at] += Fraction(mass) * s * s
        if with_pair:
            for node, sign in ((a, 1), (b, -1)):
                if node:
                    rows[node - 1][count] += sign
                    rows[count][node - 1] += sign
        return determinant(rows)

    points = [Fraction(n) for n in range(2 * count + 2)]
    bottom = interpolate([bordered(s, False) for s in points])
    top = [-c for c in interpolate([bordered(s, True) for s in points])]
    p, q = bottom, top
    while q:
        p, q = q, divide(p, q)[1]
        p = [c / p[-1] for c in p]
    print(f"{name}: {len(p) - 1} hidden")
    bottom, top = divide(bottom, p)[0], divide(top, p)[0]
    constant, rest = divide(top, bottom)
    show = lambda x: mp.nstr(x, 20, min_fixed=0, max_fixed=0)
    exact = lambda x: mpf(x.numerator) / mpf(x.denominator)
    print("    constant", show(exact(constant[0])) if constant else 0)
    lower = [exact(c) for c in bottom][::-1]
    upper = [exact(c) for c in rest][::-1]
    slope = [c * (len(lower) - 1 - i) for i, c in enumerate(lower[:-1])]
    for pole in sorted(polyroots(lower, maxsteps=5000, extraprec=2000), key=lambda z: (abs(z), z.imag)):
        strength = polyval(upper, pole) / polyval(slope, pole)
        print("    ([%s, %s], [%s, %s])," % tuple(show(x) for x in (
            pole.real, pole.imag, strength.real, strength.imag)))


bridge = {
    "springs": [(1, 2, 1.1e6), (3, 0, 2.3e-2), (2, 3, 7.7e3), (1, 3, 4.1)],
    "dashpots": [(2, 0, 1.3e-3), (1, 3, 3.7e5), (2, 3, 9.1e-6), (1, 2, 2.9e2)],
}
receptance("bridge", [0.0] * 3, a=1, b=0, **bridge)

lattice_springs, lattice_dashpots = [], []
for row in range(3):
    for column in range(3):
        node = 1 + 3 * row + column
        for other, fits in ((node + 1, column < 2), (node + 3, row < 2)):
            if fits:
                size = 10.0 ** ((7 * node + 3 * other) % 13 - 6)
                (lattice_springs if (node + other) % 4 else lattice_dashpots).append((node, other, size))
                if (node * other) % 3 == 0:
                    lattice_dashpots.append((node, other, (0.3 + 0.01 * node) * size))
# One corner is held: the response depends on differences only.
held = lambda links: [(p % 9, q % 9, value) for p, q, value in links]
receptance("lattice", [0.0] * 8, held(lattice_springs), held(lattice_dashpots), a=1, b=0)

times = [1e-8, 1e-5, 1e-3, 0.1, 3.0, 1e2, 1e5, 1e8]
weights = [3.0, 1e-6, 2e3, 5.0, 1e-3, 7.0, 1e4, 0.2]
receptance(
    "mass on a pad of eight Maxwell elements", [2.5] + [0.0] * 8,
    [(1, 2 + k, weight) for k, weight in enumerate(weights)],
    [(2 + k, 0, weight * time) for k, (weight, time) in enumerate(zip(weights, times))], a=1, b=0)

receptance(
    "masses in a bridge", [1e-3, 0.0, 40.0, 0.0, 7.0],
    [(1, 2, 1e9), (2, 3, 3e4), (1, 3, 2e2), (4, 5, 6e5), (3, 5, 1e-2), (1, 4, 5e3)],
    [(2, 3, 11.0), (3, 4, 2e3), (1, 5, 1e-4), (2, 0, 0.5)], a=1, b=5)

receptance("free masses", [2.0, 0.0, 3.0, 0.5], [(1, 2, 5.0), (3, 4, 1e5), (1, 3, 1e-2)],
           [(2, 3, 0.7), (1, 4, 1e-3)], a=1, b=4)
