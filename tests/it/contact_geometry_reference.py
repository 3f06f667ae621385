"""Reference values of pads of independent columns under bodies of a given shape.

Judge of the tests on contact geometry. Needs mpmath: python3 contact_geometry_reference.py
Writes contact_geometry_reference.csv beside itself, in some minutes. Each line: shape, law, deformation,
force, stiffness, stored energy, in SI units with 20 digits. The deformation is the double nearest to
what is written.

Stress, its slope and its integral are integrated over the radius (over half the width, of a cylinder), with
the gap of a true sphere at each radius, piece by piece between the places where a law has a break. Nothing
of the way in which the program integrates is used: that goes over the gap, and finds energies by parts.
"""

from pathlib import Path

from mpmath import asin, cos, exp, mp, mpf, nstr, pi, quad, sin, sqrt

mp.dps = 30
H = mpf(0.02)

# Radius, half the width, length of a cylinder, radius of the pad.
SHAPES = {
    "sphere": (0.05, 0.05, None, None),
    "dome": (0.05, 0.02, None, None),
    "cylinder": (0.03, 0.03, 0.1, None),
    "flat": (None, 0.03, None, None),
    "sphere-on-bulge": (0.05, 0.05, None, 0.1),
    "sphere-in-hollow": (0.08, 0.08, None, -0.09),
    "dome-in-hollow": (0.05, 0.02, None, -0.07),
    "flat-on-bulge": (None, 0.02, None, 0.06),
    "cylinder-on-bulge": (0.03, 0.03, 0.1, 0.04),
    "cylinder-in-hollow": (0.03, 0.03, 0.1, -0.05),
}
DEPTHS = [1e-4, 0.003, 0.0045, 0.009, 0.0145, 0.0199]


class Linear:
    breaks = []
    modulus = mpf(1e6)

    def stress(self, strain):
        return self.modulus * strain

    def slope(self, strain):
        return self.modulus

    def energy(self, strain):
        return self.modulus * strain**2 / 2


class Foam:
    """sigma_p (1 - e^(-E s/sigma_p)) + B (s/(1 - s))^n up to 0.99, straight on beyond."""

    last = mpf(0.99)
    breaks = [last]

    def __init__(self, exponent):
        self.modulus, self.plateau, self.dense = mpf(2e6), mpf(1e5), mpf(2e4)
        self.exponent = mpf(exponent)

    def stress(self, strain):
        if strain > self.last:
            return self.stress(self.last) + self.slope(self.last) * (strain - self.last)
        plateau = self.plateau * (1 - exp(-self.modulus * strain / self.plateau))
        return plateau + self.dense * (strain / (1 - strain)) ** self.exponent

    def slope(self, strain):
        strain = min(strain, self.last)
        n = self.exponent
        dense = self.dense * n * (strain / (1 - strain)) ** (n - 1) / (1 - strain) ** 2
        return self.modulus * exp(-self.modulus * strain / self.plateau) + dense

    def energy(self, strain):
        within = min(strain, self.last)
        beyond = strain - within
        line = (self.stress(within) + self.slope(within) * beyond / 2) * beyond
        return quad(self.stress, [0, within / 16, within / 4, within]) + line


class Table:
    """Cubics with the slopes of Fritsch and Butland, straight on beyond the last point."""

    points = [(mpf(0), mpf(0)), (mpf(0.2), mpf(3e4)), (mpf(0.5), mpf(6e4)), (mpf(0.7), mpf(4e5))]
    breaks = [point[0] for point in points[1:]]

    def __init__(self):
        x, y = zip(*self.points)
        h = [x[i + 1] - x[i] for i in range(3)]
        d = [(y[i + 1] - y[i]) / h[i] for i in range(3)]

        def inner(i):
            w, z = h[i - 1] + 2 * h[i], 2 * h[i - 1] + h[i]
            return (w + z) / (w / d[i - 1] + z / d[i])

        def end(i, j):
            slope = d[i] + (d[i] - d[j]) * h[i] / (h[i] + h[j])
            return min(max(slope, mpf(0)), 3 * d[i])

        self.slopes = [end(0, 1), inner(1), inner(2), end(2, 1)]

    def piece(self, strain):
        at = max(i for i in range(4) if i == 0 or self.points[i][0] <= strain)
        (x, y), slope = self.points[at], self.slopes[at]
        if at == 3:
            return x, [y, slope, mpf(0), mpf(0)]
        width = self.points[at + 1][0] - x
        chord = (self.points[at + 1][1] - y) / width
        square = (3 * chord - 2 * slope - self.slopes[at + 1]) / width
        cube = (slope + self.slopes[at + 1] - 2 * chord) / width**2
        return x, [y, slope, square, cube]

    def stress(self, strain):
        x, c = self.piece(strain)
        return sum(own * (strain - x) ** k for k, own in enumerate(c))

    def slope(self, strain):
        x, c = self.piece(strain)
        return sum(k * own * (strain - x) ** (k - 1) for k, own in enumerate(c) if k)

    def energy(self, strain):
        ends = [mpf(0)] + [own for own in self.breaks if own < strain] + [strain]
        total = mpf(0)
        for a, b in zip(ends, ends[1:]):
            x, c = self.piece((a + b) / 2)
            total += sum(own * ((b - x) ** (k + 1) - (a - x) ** (k + 1)) / (k + 1) for k, own in enumerate(c))
        return total


LAWS = {"linear": Linear(), "foam": Foam(3), "foam-odd": Foam(2.5), "table": Table()}


def height(radius, r):
    if radius is None:
        return mpf(0)
    radius = mpf(radius)
    size = abs(radius) - sqrt(abs((radius - r) * (radius + r)))
    return size if radius > 0 else -size


def reach(gap, depth, edge):
    """How far out the gap is less than the depth."""
    if gap(edge) <= depth:
        return edge
    low, high = mpf(0), edge
    for _ in range(120):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) < depth else (low, middle)
    return (low + high) / 2


def values(shape, law, depth):
    radius, edge, length, pad = SHAPES[shape]
    edge, depth = mpf(edge), mpf(depth)
    if pad is not None and pad > 0:
        edge = min(edge, mpf(pad))
    gap = lambda r: height(radius, r) + height(pad, r)
    last = reach(gap, depth, edge)
    ends = [reach(gap, depth - own * H, edge) for own in law.breaks if own * H < depth]
    # The square root of a sphere at its equator is smooth over an angle.
    size = min(abs(mpf(own)) for own in (radius, pad, 1) if own is not None)
    places = sorted({mpf(0), *(asin(min(own / size, mpf(1))) for own in ends + [last])})
    extra = [(3 * places[-2] + places[-1]) / 4] if len(places) > 1 else []
    places = sorted({*places, *extra})

    def over(of, factor):
        def integrand(t):
            r = size * sin(t)
            strain = max((depth - gap(r)) / H, mpf(0))
            return of(strain) * (2 * pi * r if length is None else 2 * mpf(length)) * size * cos(t)

        return factor * quad(integrand, places)

    return over(law.stress, 1), over(law.slope, 1 / H), over(law.energy, H)


def main():
    lines = [
        "# Pads of independent columns. Regenerate: python3 contact_geometry_reference.py (needs mpmath).",
        "# Parameters and methods stand in that script. SI units.",
        "shape,law,deformation,force,stiffness,stored",
    ]
    for shape in SHAPES:
        for name, law in LAWS.items():
            for depth in DEPTHS:
                if name == "foam-odd" and shape not in ("sphere", "dome"):
                    continue
                found = values(shape, law, depth)
                lines.append(f"{shape},{name},{depth}," + ",".join(nstr(own, 20) for own in found))
    # The forces of a sphere on a linear pad have a closed form.
    for line in lines[3:]:
        shape, law, depth, force, stiffness, stored = line.split(",")
        if (shape, law) == ("sphere", "linear"):
            u, factor = mpf(float(depth)), pi * mpf(1e6) / H
            for own, exact in (
                (force, mpf(0.05) * u**2 - u**3 / 3),
                (stiffness, 2 * mpf(0.05) * u - u**2),
                (stored, mpf(0.05) * u**3 / 3 - u**4 / 12),
            ):
                assert abs(mpf(own) / (factor * exact) - 1) < mpf("1e-18"), line
    Path(__file__).with_suffix(".csv").write_text("\n".join(lines) + "\n")


main()
