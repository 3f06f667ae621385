"""Laws of single parts, as docs/elements.md states them: force and slopes over deformation and rate, by phase.

A part has a phase, and `ends(phase)` lists what ends it: (what, sign, level, follower), where `what` is y (deformation),
w (rate), or F (the force that a constraint bears), positive while the phase lasts: sign * (value - level). A phase
whose `held` is a number keeps the deformation there; its force follows from balance.
"""

import numpy as np


class Part:
    """A smooth law. `levels` are deformations at which its derivatives jump; the phase counts those below y."""

    levels = ()
    has_rate = False  # whether the force depends on the rate, so that a massless joint has a rate by it
    is_linear = False

    def start(self, y, w):
        return sum(1 for own in self.levels if y > own or (y == own and w >= 0))

    def ends(self, phase):
        found = []
        if phase > 0:
            found.append(("y", 1, self.levels[phase - 1], phase - 1))
        if phase < len(self.levels):
            found.append(("y", -1, self.levels[phase], phase + 1))
        return found

    def held(self, phase):
        return None

    def enter(self, phase, y):
        """The phase that follows, with what it remembers of the place."""
        return phase


class Spring(Part):
    is_linear = True

    def __init__(self, k):
        self.k = k

    def law(self, phase, y, w):
        return self.k * y, self.k + 0 * y, 0 * y


class Dashpot(Part):
    is_linear = True
    has_rate = True

    def __init__(self, c):
        self.c = c

    def law(self, phase, y, w):
        return self.c * w, 0 * y, self.c + 0 * y


def power(u, n):
    """|u|^n sgn u and its slope."""
    size = np.abs(u)
    return np.sign(u) * size**n, n * size ** (n - 1)


def is_odd(n):
    return n == int(n) and int(n) % 2 == 1


class PowerSpring(Part):
    def __init__(self, force, at, exponent):
        self.force, self.at, self.n = force, at, exponent
        self.levels = () if is_odd(exponent) else (0.0,)

    def law(self, phase, y, w):
        own, slope = power(y / self.at, self.n)
        return self.force * own, self.force / self.at * slope, 0 * y


class CubicSpring(Part):
    def __init__(self, stiffness, cubic):
        self.k, self.k3 = stiffness, cubic

    def law(self, phase, y, w):
        return self.k * y + self.k3 * y**3, self.k + 3 * self.k3 * y**2, 0 * y


class StiffeningSpring(Part):
    """Phases: beyond 0.999 of the limit in tension, within, beyond in compression."""

    def __init__(self, stiffness, limit):
        self.k, self.limit = stiffness, limit
        self.levels = (-0.999 * limit, 0.999 * limit)

    def law(self, phase, y, w):
        if phase == 1:
            # A trial of Newton's method may go beyond the limit, no solution can.
            at = np.clip(y, -0.99999 * self.limit, 0.99999 * self.limit)
        else:
            at = np.array(self.levels[phase // 2])
        own = np.tan(np.pi * at / (2 * self.limit))
        slope = self.k * (1 + own**2)
        beyond = 0 * y if phase == 1 else slope * (y - at)
        return 2 * self.k * self.limit / np.pi * own + beyond, slope + 0 * y, 0 * y


class Curve:
    """Cubics through points by the slopes of Fritsch and Butland; straight beyond them."""

    def __init__(self, points):
        self.x, self.v = (np.array([own[i] for own in points], float) for i in (0, 1))
        h, d = np.diff(self.x), np.diff(self.v) / np.diff(self.x)
        m = np.zeros(len(self.x))
        if len(d) == 1:
            m[:] = d[0]
        else:
            for i in range(1, len(d)):
                if d[i - 1] * d[i] > 0:
                    one, two = 2 * h[i] + h[i - 1], h[i] + 2 * h[i - 1]
                    m[i] = (one + two) / (one / d[i - 1] + two / d[i])
            m[0] = self.end(h[0], h[1], d[0], d[1])
            m[-1] = self.end(h[-1], h[-2], d[-1], d[-2])
        self.m = m

    @staticmethod
    def end(h0, h1, d0, d1):
        """Slope of the parabola through three points at the first, between 0 and three times the interval's."""
        own = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
        if own * d0 <= 0:
            return 0.0
        return 3 * d0 if abs(own) > 3 * abs(d0) else own

    def piece(self, i, y):
        """Value and slope by piece i, continued; 0 and the last one are the straight lines."""
        if i == 0:
            return self.v[0] + self.m[0] * (y - self.x[0]), self.m[0] + 0 * y
        if i == len(self.x):
            return self.v[-1] + self.m[-1] * (y - self.x[-1]), self.m[-1] + 0 * y
        h = self.x[i] - self.x[i - 1]
        d = (self.v[i] - self.v[i - 1]) / h
        m0, m1, s = self.m[i - 1], self.m[i], y - self.x[i - 1]
        b, a = (3 * d - 2 * m0 - m1) / h, (m0 + m1 - 2 * d) / h**2
        return self.v[i - 1] + s * (m0 + s * (b + s * a)), m0 + s * (2 * b + 3 * a * s)

    def at(self, y):
        return self.piece(int(np.searchsorted(self.x, y)), y)[0]


class TableSpring(Part):
    def __init__(self, points):
        self.curve = Curve(points)
        self.levels = tuple(self.curve.x)

    def law(self, phase, y, w):
        own, slope = self.curve.piece(phase, y)
        return own, slope, 0 * y


class Foam(Part):
    """A block of foam; phases: tension, compression, beyond a strain of 0.99."""

    def __init__(self, modulus, plateau, densification, exponent, thickness, area):
        self.E, self.p, self.B, self.n, self.h, self.A = modulus, plateau, densification, exponent, thickness, area
        self.levels = (0.0, 0.99 * thickness)

    def curve(self, strain):
        x = np.minimum(strain, 0.995)
        fall = np.exp(-self.E * x / self.p)
        ratio = np.maximum(x, 0) / (1 - x)
        own = self.p * (1 - fall) + self.B * ratio**self.n
        slope = self.E * fall + self.B * self.n * ratio ** (self.n - 1) / (1 - x) ** 2
        return own, slope

    def law(self, phase, y, w):
        strain = y / self.h
        if phase == 0:
            own, slope = self.E * strain, self.E + 0 * y
        elif phase == 1:
            own, slope = self.curve(strain)
        else:
            own, slope = self.curve(np.array(0.99))
            own, slope = own + slope * (strain - 0.99), slope + 0 * y
        return self.A * own, self.A / self.h * slope, 0 * y


class RateSpring(Part):
    """Phases: (sign of the deformation, sign of the rate)."""

    has_rate = True

    def __init__(self, force, at, gain, reference, exponent):
        self.force, self.at, self.a, self.v, self.n = force, at, gain, reference, exponent

    def start(self, y, w):
        side = 1 if y > 0 or (y == 0 and w >= 0) else -1
        return (side, 1 if w >= 0 else -1)

    def ends(self, phase):
        side, way = phase
        return [("y", side, 0.0, (-side, way)), ("w", way, 0.0, (side, -way))]

    def law(self, phase, y, w):
        own, slope = power(y / self.at, self.n)
        own, slope = self.force * own, self.force / self.at * slope
        if phase[0] != phase[1]:
            return own, slope, 0 * y
        ratio = np.maximum(phase[1] * w, 0) / self.v
        rise = 1 + self.a * np.log1p(ratio)
        return own * rise, slope * rise, own * self.a * phase[1] / (self.v * (1 + ratio))


class PowerDashpot(Part):
    """Phases: the sign of the rate."""

    has_rate = True

    def __init__(self, force, at, exponent):
        self.force, self.at, self.p = force, at, exponent

    def start(self, y, w):
        return 1 if w >= 0 else -1

    def ends(self, phase):
        return [] if is_odd(self.p) else [("w", phase, 0.0, -phase)]

    def law(self, phase, y, w):
        u = w / self.at
        if self.p < 1:
            u = np.where(np.abs(u) < 1e-14, 1e-14 * phase, u)
        own, slope = power(u, self.p)
        return self.force * own, 0 * y, self.force / self.at * slope


class HuntCrossley(Part):
    """Phases: `off`, `on`, and `clipped` where it would pull."""

    has_rate = True

    def __init__(self, force, at, dissipation, exponent, gap):
        self.force, self.at, self.c, self.n, self.gap = force, at, dissipation, exponent, gap

    def start(self, y, w):
        if y > self.gap or (y == self.gap and w > 0):
            return "on" if 1 + self.c * w > 0 else "clipped"
        return "off"

    def ends(self, phase):
        if phase == "off":
            return [("y", -1, self.gap, "on")]
        if phase == "clipped":
            return [("y", 1, self.gap, "off"), ("w", -1, -1 / self.c, "on")]
        found = [("y", 1, self.gap, "off")]
        return found + ([("w", 1, -1 / self.c, "clipped")] if self.c else [])

    def law(self, phase, y, w):
        if phase != "on":
            return 0 * y, 0 * y, 0 * y
        own, slope = power((y - self.gap) / self.at, self.n)
        rise = 1 + self.c * w
        return self.force * own * rise, self.force / self.at * slope * rise, self.force * own * self.c


def bumper(force, at, restitution, speed, exponent, gap):
    """The Hunt-Crossley contact with a wanted restitution: d (1 + e) = ln((1 + d)/(1 - e d)), c = d/v."""
    e = restitution
    low, high = 0.0, 1 / e
    f = lambda d: np.log1p(d) - np.log1p(-e * d) - d * (1 + e)
    low = 1e-6
    # The trivial root 0 is left out: below the other one f is negative.
    for _ in range(200):
        middle = (low + high) / 2
        if f(middle) < 0:
            low = middle
        else:
            high = middle
    return HuntCrossley(force, at, (low + high) / 2 / speed, exponent, gap)


class Hysteretic(Part):
    """Loading by first(i, y), unloading from ym by that times part(j, y/ym), slack below rest ym.

    Phases: ("load", i), ("back", ym, i), ("slack", ym). The pieces of `first` meet at `levels`, those of `part` at
    the parts `marks` of ym.
    """

    def __init__(self, first, part, rest, levels=(), marks=()):
        self.first, self.part, self.rest, self.inner, self.marks = first, part, rest, tuple(levels), tuple(marks)

    def levels_of(self, ym):
        """Where pieces meet on the way back, its ends included."""
        between = {own for own in self.inner if self.rest * ym < own < ym} | {own * ym for own in self.marks}
        return [self.rest * ym, *sorted(between), ym]

    def start(self, y, w):
        return ("load", 0) if y == 0 and w > 0 else ("slack", 0.0)

    def enter(self, phase, y):
        return ("back", y, len(self.levels_of(y)) - 2) if phase[0] == "turn" else phase

    def ends(self, phase):
        word, i = phase[0], phase[-1]
        if word == "slack":
            ym = phase[1]
            return [("y", -1, self.rest * ym, ("back", ym, 0) if ym else ("load", 0))]
        if word == "load":
            found = [("w", 1, 0.0, ("turn",))]
            return found + ([("y", -1, self.inner[i], ("load", i + 1))] if i < len(self.inner) else [])
        ym = phase[1]
        levels = self.levels_of(ym)
        low = ("slack", ym) if i == 0 else ("back", ym, i - 1)
        is_last = i == len(levels) - 2
        high = ("load", sum(1 for own in self.inner if own <= ym)) if is_last else ("back", ym, i + 1)
        return [("y", 1, levels[i], low), ("y", -1, levels[i + 1], high)]

    def law(self, phase, y, w):
        if phase[0] == "slack":
            return 0 * y, 0 * y, 0 * y
        if phase[0] == "load":
            own, slope = self.first(phase[1], y)
            return own, slope, 0 * y
        ym, i = phase[1:]
        levels = self.levels_of(ym)
        middle = (levels[i] + levels[i + 1]) / 2
        own, slope = self.first(sum(1 for level in self.inner if level < middle), y)
        part, rise = self.part(sum(1 for mark in self.marks if mark * ym < middle), y / ym)
        return own * part, slope * part + own * rise / ym, 0 * y


def hysteretic_foam(foam, rest, q):
    def first(i, y):
        return foam.law(i + 1, y, 0 * y)[:2]

    def part(_, u):
        own, slope = power((u - rest) / (1 - rest), q)
        return own, slope / (1 - rest)

    return Hysteretic(first, part, rest, (0.99 * foam.h,))


def hysteretic_table(loading, unloading):
    """The part of the first curve that the second one is, over the parts of the depth from which it was unloaded."""
    first_curve, second = Curve(loading), Curve(unloading)
    depth = unloading[-1][0]
    marks = sorted({own / depth for own in (*first_curve.x, *second.x) if second.x[0] < own < depth})
    places = [second.x[0] / depth, *marks, 1.0]

    def first(i, y):
        return first_curve.piece(i + 1, y)

    def part(j, u):
        middle = depth * (places[j] + places[j + 1]) / 2
        above, rise = first_curve.piece(int(np.searchsorted(first_curve.x, middle)), u * depth)
        own, slope = second.piece(int(np.searchsorted(second.x, middle)), u * depth)
        return own / above, depth * (slope * above - own * rise) / above**2

    if any(np.min(part(j, np.linspace(places[j], places[j + 1], 1001))[1]) < 0 for j in range(len(places) - 1)):
        raise ArithmeticError("a part of the first curve that falls between points")
    return Hysteretic(first, part, places[0], first_curve.x[1:], marks)


class Contact(Part):
    """Phases: `open`, `closed`."""

    def __init__(self, gap, restitution):
        self.gap, self.e = gap, restitution

    def start(self, y, w):
        return "closed" if y >= self.gap and w >= 0 else "open"

    def ends(self, phase):
        return [("y", -1, self.gap, "closed")] if phase == "open" else [("F", 1, 0.0, "open")]

    def held(self, phase):
        return self.gap if phase == "closed" else None

    def law(self, phase, y, w):
        return 0 * y, 0 * y, 0 * y


class Friction(Part):
    """Phases: ("stuck", y), ("slide", way)."""

    def __init__(self, strength):
        self.strength = strength

    def start(self, y, w):
        return ("slide", 1 if w > 0 else -1) if w != 0 else ("stuck", y)

    def enter(self, phase, y):
        return ("stuck", y) if phase == ("stuck",) else phase

    def ends(self, phase):
        if phase[0] == "stuck":
            return [("F", -1, self.strength, ("slide", 1)), ("F", 1, -self.strength, ("slide", -1))]
        return [("w", phase[1], 0.0, ("stuck",))]

    def held(self, phase):
        return phase[1] if phase[0] == "stuck" else None

    def law(self, phase, y, w):
        return phase[1] * self.strength + 0 * y, 0 * y, 0 * y


class Rigid(Part):
    def start(self, y, w):
        return "rigid"

    def ends(self, phase):
        return []

    def held(self, phase):
        return 0.0

    def law(self, phase, y, w):
        return 0 * y, 0 * y, 0 * y
