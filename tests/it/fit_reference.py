#!/usr/bin/env python3
"""Records of twelve pads, made by a Runge-Kutta method of order 4 that knows nothing of dashpot, and the coverage of its fits.

  fit_reference.py DASHPOT [--repeats N] [--from N] [--pads a,b]   fits each record and counts the intervals that hold the truth
  fit_reference.py --record PAD SEED                               writes the record of one repeat to standard output

A mass meets a pad that cannot pull. The record begins about 4 ms before the touch, which falls anywhere between two
samples, has white noise, and a zero that is off. The numbers start from three times or a third of the truth. A fit that
did not converge is a miss of all of its numbers, and so is an interval that lacks an end.
"""
import json, math, os, random, subprocess, sys, tempfile, time

RATE = 10e3
BEFORE = 4e-3
STEP = 2e-6


class Pad:
    """Mass [kg], speed [m/s], noise [m/s2], length behind the touch [s]; numbers: name -> (truth, low, high, unit);
    law(numbers) -> force(y, v, memory), which may keep what it needs between steps in `memory`."""

    def __init__(self, mass, speed, noise, length, numbers, element, law):
        self.mass, self.speed, self.noise, self.length = mass, speed, noise, length
        self.numbers, self.element, self.law = numbers, element, law
        self.curve = None

    def scene(self, starts):
        values = "".join(f'{n} = "{starts[n]:.9g} {own[3]}"\n' for n, own in self.numbers.items())
        return (f'[values]\n{values}[nodes]\nhead = {{ mass = "{self.mass} kg", velocity = "{self.speed} m/s" }}\n'
                f'[elements]\npad = {{ between = ["head", "ground"], {self.element} }}\n'
                f'[effects]\nseparation.pad = {{}}\n[run]\nduration = "{1.5e3 * self.length} ms"\n')

    def solved(self):
        """The deceleration at multiples of STEP from the touch to the release."""
        if self.curve is None:
            law = self.law({n: own[0] * SI[own[3]] for n, own in self.numbers.items()})
            y, v, z, curve, h, m = 0.0, self.speed, list(law.start), [], STEP, self.mass
            while len(curve) * h < 10 * self.length:
                f = law.force(y, v, z)
                if curve and f <= 0.0:
                    break
                curve.append(f / m)
                k1 = (v, -f / m, law.rates(y, v, z))
                s = [a + h / 2 * b for a, b in zip(z, k1[2])]
                k2 = (v + h / 2 * k1[1], -law.force(y + h / 2 * k1[0], v + h / 2 * k1[1], s) / m,
                      law.rates(y + h / 2 * k1[0], v + h / 2 * k1[1], s))
                s = [a + h / 2 * b for a, b in zip(z, k2[2])]
                k3 = (v + h / 2 * k2[1], -law.force(y + h / 2 * k2[0], v + h / 2 * k2[1], s) / m,
                      law.rates(y + h / 2 * k2[0], v + h / 2 * k2[1], s))
                s = [a + h * b for a, b in zip(z, k3[2])]
                k4 = (v + h * k3[1], -law.force(y + h * k3[0], v + h * k3[1], s) / m,
                      law.rates(y + h * k3[0], v + h * k3[1], s))
                y += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
                v += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
                z = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(z, k1[2], k2[2], k3[2], k4[2])]
                law.stepped(y, v)
            self.curve = curve
        return self.curve

    def record(self, seed):
        curve, draw = self.solved(), random.Random(f"{self.element} {seed}")
        late, zero = BEFORE + draw.random() / RATE, draw.gauss(0, self.noise)
        rows = ["t [s],acc [m/s^2]"]
        for at in range(int((BEFORE + self.length) * RATE)):
            place = (at / RATE - late) / STEP
            low = math.floor(place)
            value = 0.0
            if 0 <= low < len(curve) - 1:
                value = curve[low] + (place - low) * (curve[low + 1] - curve[low])
            rows.append(f"{at / RATE:.6f},{value + zero + draw.gauss(0, self.noise):.5f}")
        return "\n".join(rows) + "\n"


class Law:
    """A force of deformation and rate, with inner deformations z where it has some."""
    start = ()

    def __init__(self, force):
        self.of = force

    def force(self, y, v, z):
        return self.of(y, v)

    def rates(self, y, v, z):
        return []

    def stepped(self, y, v):
        pass


class Branch(Law):
    """A spring beside a spring and a dashpot in series, whose dashpot has the deformation z."""
    start = (0.0,)

    def __init__(self, spring, branch, dashpot):
        self.constants = spring, branch, dashpot

    def force(self, y, v, z):
        return self.constants[0] * y + self.constants[1] * (y - z[0])

    def rates(self, y, v, z):
        return [self.constants[1] * (y - z[0]) / self.constants[2]]


class Unloading(Law):
    """A law that unloads from its deepest point on f(y) s^q, s = (y - set y_m)/(y_m - set y_m)."""

    def __init__(self, force, part, exponent):
        self.of, self.part, self.exponent, self.deepest = force, part, exponent, None

    def force(self, y, v, z):
        if self.deepest is None:
            return self.of(y)
        s = (y / self.deepest - self.part) / (1 - self.part)
        return self.of(y) * s ** self.exponent if s > 0 else 0.0

    def stepped(self, y, v):
        if self.deepest is None and v <= 0:
            self.deepest = y


def foam(modulus, plateau, densification, exponent=2.0, thickness=0.025, area=0.008):
    def force(y):
        e = y / thickness
        if e <= 0:
            return area * modulus * e
        e = min(e, 0.99)
        return area * (plateau * (1 - math.exp(-modulus * e / plateau)) + densification * (e / (1 - e)) ** exponent)
    return force


def kelvin(k, c):
    return Law(lambda y, v: k * y + c * v)


SI = {"kN/m": 1e3, "N s/m": 1.0, "MPa": 1e6, "kN": 1e3, "s/m": 1.0, "mm": 1e-3, "": 1.0, "N": 1.0, "MN/m^3": 1e6}
K, C = (30.0, 5, 500, "kN/m"), (100.0, 10, 5000, "N s/m")
FOAM = {"E": (10.0, 1, 100, "MPa"), "P": (0.5, 0.05, 5, "MPa"), "D": (0.2, 0.02, 2, "MPa")}
FOAMED = 'foam = { modulus = "E", plateau = "P", densification = "D", exponent = 2.0, thickness = "25 mm", area = "80 cm^2" }'
PADS = {
    # Linear.
    "kelvin": Pad(4, 2, 1.0, 0.045, {"K": K, "C": C}, 'kelvin-voigt = { spring = "K", dashpot = "C" }',
                  lambda n: kelvin(n["K"], n["C"])),
    "damped": Pad(4, 2, 1.0, 0.045, {"K": K, "C": (350.0, 10, 5000, "N s/m")},
                  'parallel = [{ spring = "K" }, { dashpot = "C" }]', lambda n: kelvin(n["K"], n["C"])),
    "maxwell": Pad(4, 3, 2.0, 0.03, {"K": (200.0, 10, 2000, "kN/m"), "C": (1500.0, 100, 20000, "N s/m")},
                   'series = [{ spring = "K" }, { dashpot = "C" }]', lambda n: Branch(0.0, n["K"], n["C"])),
    "zener": Pad(4, 2, 1.0, 0.04, {"K": K, "K1": (60.0, 5, 500, "kN/m"), "C1": (200.0, 10, 5000, "N s/m")},
                 'zener = { spring = "K", maxwell = { spring = "K1", dashpot = "C1" } }',
                 lambda n: Branch(n["K"], n["K1"], n["C1"])),
    # Foam.
    "foam": Pad(5, 5, 5.0, 0.025, FOAM, FOAMED,
                lambda n: Law(lambda y, v, f=foam(n["E"], n["P"], n["D"]): f(y))),
    "damped-foam": Pad(5, 5, 5.0, 0.025, {**FOAM, "C": (300.0, 30, 3000, "N s/m")},
                       f'parallel = [{{ {FOAMED} }}, {{ dashpot = "C" }}]',
                       lambda n: Law(lambda y, v, f=foam(n["E"], n["P"], n["D"]), c=n["C"]: f(y) + c * v)),
    "cubic": Pad(4, 3, 2.0, 0.04, {"K": (20.0, 2, 200, "kN/m"), "Q": (100.0, 10, 1000, "MN/m^3"), "C": (150.0, 10, 2000, "N s/m")},
                 'parallel = [{ cubic-spring = { stiffness = "K", cubic = "Q" } }, { dashpot = "C" }]',
                 lambda n: Law(lambda y, v: n["K"] * y + n["Q"] * y ** 3 + n["C"] * v)),
    # Hysteresis.
    "hunt-crossley": Pad(4, 2, 1.0, 0.04, {"F": (1.0, 0.1, 10, "kN"), "D": (0.2, 0.02, 2, "s/m")},
                         'hunt-crossley = { force = "F", at = "20 mm", dissipation = "D", exponent = 1.5 }',
                         lambda n: Law(lambda y, v: n["F"] * (max(y, 0) / 0.02) ** 1.5 * max(1 + n["D"] * v, 0))),
    "hysteretic-foam": Pad(5, 5, 5.0, 0.025, {"P": FOAM["P"], "D": FOAM["D"], "Q": (4.0, 1, 20, "")},
                           'hysteretic-foam = { modulus = "10 MPa", plateau = "P", densification = "D", exponent = 2.0, '
                           'thickness = "25 mm", area = "80 cm^2", set = 0.1, unloading-exponent = "Q" }',
                           lambda n: Unloading(foam(10e6, n["P"], n["D"]), 0.1, n["Q"])),
    "friction": Pad(4, 2, 1.0, 0.045, {"K": K, "F": (0.15, 0.02, 2, "kN")},
                    'parallel = [{ spring = "K" }, { friction = "F" }]',
                    lambda n: Law(lambda y, v: n["K"] * y + math.copysign(n["F"], v))),
    # Stop.
    "stop": Pad(4, 3, 2.0, 0.035, {"K": (20.0, 2, 200, "kN/m"), "C": C, "S": (200.0, 20, 2000, "kN/m"), "G": (20.0, 4, 100, "mm")},
                'parallel = [{ spring = "K" }, { dashpot = "C" }, { series = [{ contact = { gap = "G" } }, { spring = "S" }] }]',
                lambda n: Law(lambda y, v: n["K"] * y + n["C"] * v + n["S"] * max(y - n["G"], 0.0))),
    "bottoming": Pad(4, 3, 2.0, 0.035, {"K": (20.0, 2, 200, "kN/m"), "L": (30.0, 20, 200, "mm"), "C": C},
                     'parallel = [{ stiffening-spring = { stiffness = "K", limit = "L" } }, { dashpot = "C" }]',
                     lambda n: Law(lambda y, v: 2 * n["K"] * n["L"] / math.pi * math.tan(math.pi * y / (2 * n["L"])) + n["C"] * v)),
}


def starts(pad, seed):
    """Three times or a third of the truth, within the bounds."""
    draw = random.Random(f"start {pad.element} {seed}")
    return {n: min(max(own[0] * 3.0 ** draw.choice([-1, 1]), own[1]), own[2]) for n, own in pad.numbers.items()}


def fitted(binary, pad, seed, folder, extra=()):
    scene, record = os.path.join(folder, "pad.toml"), os.path.join(folder, "drop.csv")
    with open(scene, "w") as file:
        file.write(pad.scene(starts(pad, seed)))
    with open(record, "w") as file:
        file.write(pad.record(seed))
    varied = [part for n, own in pad.numbers.items() for part in ("--vary", f"{n}={own[1]}..{own[2]} {own[3]}".strip())]
    asked = [binary, "fit", scene, *varied, "--to", f"{record}:acc=head.acceleration", "--json", *extra]
    told = subprocess.run(asked, capture_output=True, text=True, timeout=300)
    if told.returncode != 0:
        return None, told.stderr
    return json.loads(told.stdout), told.stderr


def campaign(binary, repeats, first, pads, extra):
    pooled = [0, 0, 0, 0]
    with tempfile.TemporaryDirectory() as folder:
        for name in pads:
            pad = PADS[name]
            pad.solved()
            held, missed, begun, spans = {n: 0 for n in pad.numbers}, 0, time.time(), []
            for seed in range(first, first + repeats):
                own, told = fitted(binary, pad, seed, folder, extra)
                if own is None:
                    print(f"  {name} {seed}: {told.strip()[:300]}")
                if own is None or not own["converged"]:
                    missed += 1
                    if os.environ.get("VERBOSE"): print(f"  {name} {seed} not converged {own and own['starts']}")
                    continue
                bad = []
                for n, (truth, _, _, unit) in pad.numbers.items():
                    found, truth = own["parameters"][n], truth * SI[unit]
                    low, high = found["low"], found["high"]
                    holds = low is not None and high is not None and low <= truth <= high
                    held[n] += holds
                    if not holds: bad.append(f"{n} {found['value']/truth-1:+.2%} [{low and low/truth-1}, {high and high/truth-1}]")
                if bad and os.environ.get("VERBOSE"):
                    print(f"  {name} {seed} starts {own['starts']} rms {own['tests'][0]['rms']/pad.noise:.3f} {bad}")
            each = ", ".join(f"{n} {100 * count / repeats:.1f} %" for n, count in held.items())
            seconds = (time.time() - begun) / repeats
            print(f"{name}: {each}; not converged {missed} of {repeats}; {seconds:.2f} s each", flush=True)
            pooled[0] += sum(held.values())
            pooled[1] += repeats * len(held)
            pooled[2] += missed
            pooled[3] += repeats
    print(f"pooled: {100 * pooled[0] / pooled[1]:.2f} % of {pooled[1]} intervals hold; {pooled[2]} of {pooled[3]} fits not converged")


def main(words):
    if words[:1] == ["--record"]:
        sys.stdout.write(PADS[words[1]].record(int(words[2])))
        return
    options = {"--repeats": "200", "--from": "0", "--pads": ",".join(PADS)}
    binary, rest = words[0], words[1:]
    while rest and rest[0] in options:
        options[rest[0]], rest = rest[1], rest[2:]
    campaign(binary, int(options["--repeats"]), int(options["--from"]), options["--pads"].split(","), rest)


if __name__ == "__main__":
    main(sys.argv[1:])
