"""The rating of ISO/TS 18571 of pairs of generated curves, word by word: no band, no memory, no shortcut.

Judge of tests/it/rating.rs. Needs nothing but Python: python3 rating_reference.py > rating_reference.csv

Constants as in the open implementation of the Vehicle Safety Institute of TU Graz (OpenVT, objective-rating-metrics 1.3),
with whose numbers these agree to 1e-9, but for the slope of `opposed`: two shifts are as good there, and rounding picks one.
The specification itself was not at hand.

Curves of 260 samples at 0.1 ms. Warping by a recursion over the whole matrix, forbidden outside of the band.
"""

from functools import lru_cache
from math import ceil, exp, floor, pi, sin, sqrt
import sys

COUNT = 260
sys.setrecursionlimit(10000)


def pulse(k, begin, length):
    place = (k - begin) / length
    return sin(pi * place) ** 2 if 0 < place < 1 else 0.0


def test(k):
    return 180 * pulse(k, 50, 110) + 9 * sin(0.31 * k) * exp(-((k - 110) / 60) ** 2) + 0.4 * sin(0.05 * k + 1)


MODELS = {
    "same": test,
    "higher": lambda k: 1.2 * test(k),
    "later": lambda k: test(k - 13),
    "earlier": lambda k: test(k + 21),
    "opposed": lambda k: -test(k),
    "shorter": lambda k: 205 * pulse(k, 58, 84) + 0.2 * sin(0.11 * k),
    "ringing": lambda k: test(k) + 25 * sin(0.9 * k) * exp(-((k - 100) / 50) ** 2),
    "far": lambda k: test(k - 80),
    "double": lambda k: 2.1 * test(k - 3) + 3 * sin(0.02 * k),
}


def corridor(t, c):
    norm = max(map(abs, t))
    sum_ = 0.0
    for a, b in zip(t, c):
        off = abs(a - b)
        if off < 0.05 * norm:
            sum_ += 1.0
        elif off <= 0.5 * norm:
            sum_ += ((0.5 * norm - off) / (0.5 * norm - 0.05 * norm)) ** 2
    return sum_ / len(t)


def correlation(x, y):
    mx, my = sum(x) / len(x), sum(y) / len(y)
    xy = sum((a - mx) * (b - my) for a, b in zip(x, y))
    return xy / sqrt(sum((a - mx) ** 2 for a in x) * sum((b - my) ** 2 for b in y))


def shifted(t, c):
    best, pair, by = correlation(t, c), (t, c), 0
    for m in range(1, floor(0.2 * len(t)) + 1):
        for a, b in ((t[:-m], c[m:]), (t[m:], c[:-m])):
            own = correlation(a, b)
            if own > best + 1e-13:
                best, pair, by = own, (a, b), m
    return pair, by


def magnitude(t, c):
    n, band = len(t), ceil(0.1 * len(t))

    @lru_cache(None)
    def least(i, j):
        if i < 0 or j < 0 or abs(i - j) >= band:
            return (float("inf"), None)
        own = (t[i] - c[j]) ** 2
        if i == j == 0:
            return (own, None)
        steps = [(i - 1, j - 1), (i - 1, j), (i, j - 1)]
        before = min(steps, key=lambda place: least(*place)[0])
        return (least(*before)[0] + own, before)

    for i in range(n):
        for j in range(max(0, i - band), min(n, i + band)):
            least(i, j)
    place, off, size = (n - 1, n - 1), 0.0, 0.0
    while place:
        i, j = place
        off += abs(t[i] - c[j])
        size += abs(t[i])
        place = least(i, j)[1]
    return max(0.0, (0.5 - off / size) / 0.5)


def slope(t, c):
    def smooth(x):
        n = len(x)
        d = [x[1] - x[0]] + [(x[k + 1] - x[k - 1]) / 2 for k in range(1, n - 1)] + [x[-1] - x[-2]]
        out = []
        for k in range(n):
            half = min(4, k, n - 1 - k)
            out.append(sum(d[k - half:k + half + 1]) / (2 * half + 1))
        return out

    a, b = smooth(t), smooth(c)
    error = sum(abs(p - q) for p, q in zip(a, b)) / sum(map(abs, a))
    return max(0.0, (2.0 - error) / 2.0)


if __name__ == "__main__":
    print("# Made by rating_reference.py")
    print("model,corridor,phase,magnitude,slope,overall")
    t = [test(k) for k in range(COUNT)]
    for name, model in MODELS.items():
        c = [model(k) for k in range(COUNT)]
        (a, b), by = shifted(t, c)
        phase = max(0.0, 1 - by / (0.2 * COUNT))
        parts = [corridor(t, c), phase, magnitude(a, b), slope(a, b)]
        overall = 0.4 * parts[0] + 0.2 * sum(parts[1:])
        print(",".join([name] + [f"{own:.12f}" for own in parts + [overall]]))
