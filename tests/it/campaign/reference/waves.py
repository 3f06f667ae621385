"""Functions of time: value and first two derivatives, piece by piece; docs/scene-format.md has their laws."""

import numpy as np


class Wave:
    """Pieces [(from, function of t giving (u, u', u''))], the first from -inf on."""

    def __init__(self, pieces, text, word="motion"):
        self.pieces, self.text, self.word = pieces, text, word

    def breaks(self):
        return [own for own, _ in self.pieces[1:]]

    def at(self, t, when):
        """Values at `t` by the piece that holds at `when`, which lies within it."""
        chosen = [own for start, own in self.pieces if start <= when][-1]
        return chosen(np.asarray(t, float))


def line(t0, u0, slope):
    return lambda t: (u0 + slope * (t - t0), slope + 0 * t, 0 * t)


def flat(u):
    return line(0.0, u, 0.0)


def harmonic(amplitude, omega, phase, offset=0.0):
    """offset + amplitude sin(omega t + phase)"""

    def own(t):
        a = omega * t + phase
        return offset + amplitude * np.sin(a), amplitude * omega * np.cos(a), -amplitude * omega**2 * np.sin(a)

    return own


def constant(value, start=0.0):
    pieces = [(-np.inf, flat(0.0)), (start, flat(value))] if start > 0 else [(-np.inf, flat(value))]
    return Wave(pieces, f"constant = {{ value = {value!r}, start = {start!r} }}")


def ramp(height, rise, start):
    pieces = [(-np.inf, flat(0.0)), (start, line(start, 0.0, height / rise)), (start + rise, flat(height))]
    return Wave(pieces, f"ramp = {{ height = {height!r}, rise = {rise!r}, start = {start!r} }}")


def sine(amplitude, frequency, phase=0.0):
    own = harmonic(amplitude, 2 * np.pi * frequency, phase)
    return Wave(
        [(-np.inf, own)], f"sine = {{ amplitude = {amplitude!r}, frequency = {frequency!r}, phase = {phase!r} }}"
    )


def half_sine(peak, duration, start):
    omega = np.pi / duration
    pieces = [(-np.inf, flat(0.0)), (start, harmonic(peak, omega, -omega * start)), (start + duration, flat(0.0))]
    return Wave(pieces, f"half-sine = {{ peak = {peak!r}, duration = {duration!r}, start = {start!r} }}")


def haversine(peak, duration, start):
    omega = 2 * np.pi / duration
    own = harmonic(-peak / 2, omega, np.pi / 2 - omega * start, peak / 2)
    pieces = [(-np.inf, flat(0.0)), (start, own), (start + duration, flat(0.0))]
    return Wave(pieces, f"haversine = {{ peak = {peak!r}, duration = {duration!r}, start = {start!r} }}")


def trapezoid(peak, rise, hold, fall, start):
    a, b, c = start + rise, start + rise + hold, start + rise + hold + fall
    pieces = [(-np.inf, flat(0.0)), (start, line(start, 0.0, peak / rise)), (a, flat(peak))]
    pieces += [(b, line(b, peak, -peak / fall)), (c, flat(0.0))]
    words = f"peak = {peak!r}, rise = {rise!r}, hold = {hold!r}, fall = {fall!r}, start = {start!r}"
    return Wave(pieces, f"trapezoid = {{ {words} }}")


def chirp(amplitude, low, high, duration):
    rate = (high - low) / duration

    def swept(t):
        a = 2 * np.pi * (low * t + rate * t**2 / 2)
        da, dda = 2 * np.pi * (low + rate * t), 2 * np.pi * rate
        return amplitude * np.sin(a), amplitude * da * np.cos(a), amplitude * (dda * np.cos(a) - da**2 * np.sin(a))

    turned = 2 * np.pi * (low * duration + rate * duration**2 / 2)
    after = harmonic(amplitude, 2 * np.pi * high, turned - 2 * np.pi * high * duration)
    words = f"amplitude = {amplitude!r}, from = {low!r}, to = {high!r}, duration = {duration!r}"
    return Wave([(-np.inf, swept), (duration, after)], f"chirp = {{ {words} }}")


def table(points):
    pieces = [(-np.inf, flat(points[0][1]))]
    for (t0, u0), (t1, u1) in zip(points, points[1:]):
        if t1 > t0:
            pieces.append((t0, line(t0, u0, (u1 - u0) / (t1 - t0))))
    pieces.append((points[-1][0], flat(points[-1][1])))
    return Wave(pieces, "table = [" + ", ".join(f"[{t!r}, {u!r}]" for t, u in points) + "]")


def accelerated(peak, duration, start):
    """The place that an acceleration of half a sine leads to."""
    omega = np.pi / duration
    speed = peak / omega

    def during(t):
        s = t - start
        return speed * (s - np.sin(omega * s) / omega), speed * (1 - np.cos(omega * s)), peak * np.sin(omega * s)

    pieces = [
        (-np.inf, flat(0.0)),
        (start, during),
        (start + duration, line(start + duration, speed * duration, 2 * speed)),
    ]
    return Wave(
        pieces, f"half-sine = {{ peak = {peak!r}, duration = {duration!r}, start = {start!r} }}", "acceleration"
    )
