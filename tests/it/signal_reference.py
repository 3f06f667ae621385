"""A ringing pulse through CFC filters by way of its spectrum, and its head injury criterion by trying all intervals.

Judge of tests/it/signal.rs. Needs nothing but Python: python3 signal_reference.py > signal_reference.csv

Filter: the record stands in a long one of zeros; each line of its spectrum is multiplied by the gain of both passes,
1/(1 + (tan(pi f T)/tan(pi 2.0775 CFC T))^4). There is no recursion, no direction and no state.
Criterion: the line through the samples, integrated in closed form, over all intervals between sixteenths of a step
up to 15 ms; then between ever smaller parts of a step about the best of them.
"""

from cmath import exp, pi
from math import sin, tan
from math import exp as real_exp

COUNT, FRAME, EVERY = 256, 2048, 8


def sample(k):
    pulse = 200 * sin(pi * k / 100) if 0 <= k < 100 else 0.0
    return pulse + 60 * sin(0.9 * k) * real_exp(-k / 40)


values = [sample(k) for k in range(COUNT)]


def filtered(cfc, rate):
    design = tan(pi * 2.0775 * cfc / rate)
    spectrum = []
    for line in range(FRAME):
        turn = exp(-2j * pi * line / FRAME)
        at, sum_ = 1.0, 0.0
        for value in values:
            sum_ += value * at
            at *= turn
        place = min(line, FRAME - line) / FRAME
        gain = 1 / (1 + (tan(pi * place) / design) ** 4) if place < 0.5 else 0.0
        spectrum.append(gain * sum_)
    out = []
    for k in range(0, COUNT, EVERY):
        out.append(sum(s * exp(2j * pi * line * k / FRAME) for line, s in enumerate(spectrum)).real / FRAME)
    return out


def hic(rate, cap):
    step = 1 / rate
    # Integral of the line up to each sample; within a step in closed form.
    def part(k, share):
        return 0.5 * step * share * (2 * values[k] + share * (values[k + 1] - values[k]))

    sums = [0.0]
    for k in range(COUNT - 1):
        sums.append(sums[-1] + part(k, 1.0))

    def until(place):
        k = min(int(place), COUNT - 2)
        return sums[k] + part(k, place - k)

    def criterion(a, b):
        length = (b - a) * step
        return length * (abs(until(b) - until(a)) / length) ** 2.5

    places = [k / 16 for k in range(16 * (COUNT - 1) + 1)]
    table = [until(place) for place in places]
    best = (0.0, 0.0, 0.0)
    for i in range(len(places)):
        for j in range(i + 1, len(places)):
            length = (places[j] - places[i]) * step
            if length > cap * (1 + 1e-12):
                break
            found = length * (abs(table[j] - table[i]) / length) ** 2.5
            if found > best[0]:
                best = (found, places[i], places[j])
    width = 1 / 16
    for _ in range(20):
        _, a, b = best
        for da in range(-4, 5):
            for db in range(-4, 5):
                x, y = max(0.0, a + da * width / 4), min(COUNT - 1.0, b + db * width / 4)
                if 0 < (y - x) * step <= cap * (1 + 1e-12):
                    best = max(best, (criterion(x, y), x, y))
        width /= 2
    return best[0]


print("# Made by signal_reference.py")
print("what,class,rate,sample,value")
for cfc, rate in ((60, 10e3), (180, 20e3), (600, 20e3), (1000, 20e3)):
    for at, value in enumerate(filtered(cfc, rate)):
        print(f"cfc,{cfc},{rate:.0f},{EVERY * at},{value:.12g}")
for rate in (5e3, 20e3):
    print(f"hic15,0,{rate:.0f},0,{hic(rate, 0.015):.12g}")
