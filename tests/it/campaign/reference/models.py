"""Models from dice: the laws of elements, composed, each with its text."""

import math

import numpy as np

import laws


class Dice:
    def __init__(self, seed):
        self.own = np.random.Generator(np.random.PCG64(seed))

    def between(self, low, high):
        return float(f"{self.own.uniform(low, high):.6g}")

    def spread(self, low, high):
        return float(f"{low * (high / low) ** self.own.uniform():.6g}")

    def chance(self, part):
        return self.own.uniform() < part

    def pick(self, *options):
        return options[int(self.own.integers(len(options)))]


class Leaf:
    def __init__(self, part, text):
        self.part, self.text = part, text


class Row:
    def __init__(self, *own, text=None):
        self.own = list(own)
        self.text = text or "series = [" + ", ".join(f"{{ {one.text} }}" for one in own) + "]"


class Beside:
    def __init__(self, *own, text=None):
        self.own = list(own)
        self.text = text or "parallel = [" + ", ".join(f"{{ {one.text} }}" for one in own) + "]"


def spring(k):
    return Leaf(laws.Spring(k), f"spring = {k!r}")


def dashpot(c):
    return Leaf(laws.Dashpot(c), f"dashpot = {c!r}")


def contact(gap, e=0.0):
    return Leaf(laws.Contact(gap, e), f"contact = {{ gap = {gap!r}, restitution = {e!r} }}")


def friction(f):
    return Leaf(laws.Friction(f), f"friction = {f!r}")


def inside(own):
    return f"{{ {own} }}"


def kelvin(k, c):
    return Beside(spring(k), dashpot(c), text=f"kelvin-voigt = {{ spring = {k!r}, dashpot = {c!r} }}")


def maxwell(k, c):
    return Row(spring(k), dashpot(c), text=f"maxwell = {{ spring = {k!r}, dashpot = {c!r} }}")


def zener(k, arm, c):
    text = f"zener = {{ spring = {k!r}, maxwell = {{ spring = {arm!r}, dashpot = {c!r} }} }}"
    return Beside(spring(k), maxwell(arm, c), text=text)


def burgers(k1, c1, k2, c2):
    inner = f"maxwell = {{ spring = {k1!r}, dashpot = {c1!r} }}, kelvin = {{ spring = {k2!r}, dashpot = {c2!r} }}"
    return Row(spring(k1), dashpot(c1), kelvin(k2, c2), text=f"burgers = {{ {inner} }}")


def jeffreys(c1, k, c):
    text = f"jeffreys = {{ dashpot = {c1!r}, kelvin = {{ spring = {k!r}, dashpot = {c!r} }} }}"
    return Row(dashpot(c1), kelvin(k, c), text=text)


def prony(k, terms):
    text = f"prony = {{ equilibrium = {k!r}, terms = [" + ", ".join(f"[{t!r}, {own!r}]" for t, own in terms) + "] }"
    return Beside(spring(k), *(maxwell(own, own * t) for t, own in terms), text=text)


def kelvin_chain(terms):
    text = "kelvin-chain = [" + ", ".join(f"[{t!r}, {j!r}]" for t, j in terms) + "]"
    return Row(*(kelvin(1 / j, t / j) for t, j in terms), text=text)


def points(own):
    return "[" + ", ".join(f"[{y!r}, {f!r}]" for y, f in own) + "]"


def table_loop(loading, unloading):
    text = f"hysteretic-table = {{ loading = {points(loading)}, unloading = {points(unloading)} }}"
    return Leaf(laws.hysteretic_table(loading, unloading), text)


def table_spring(own, c):
    return Beside(Leaf(laws.TableSpring(own), f"table-spring = {points(own)}"), dashpot(c))


def pulls(tree):
    """Whether it can pull by its law."""
    if isinstance(tree, Leaf):
        return not isinstance(tree.part, (laws.Contact, laws.HuntCrossley, laws.Hysteretic))
    return all(map(pulls, tree.own)) if isinstance(tree, Row) else any(map(pulls, tree.own))


class Scales:
    def __init__(self, dice):
        self.m, self.v = dice.spread(0.3, 30), dice.between(0.8, 9)
        self.k = dice.spread(3e3, 3e6)
        self.set()

    def set(self):
        beat, impedance = math.sqrt(self.m / self.k), math.sqrt(self.m * self.k)
        self.t, self.y, self.f, self.c = math.pi * beat, self.v * beat, self.v * impedance, 2 * impedance


def rigid():
    return Leaf(laws.Rigid(), "rigid = true")


def scaled(tree, stiffness, damping):
    """The same model with its constants multiplied; without a text."""
    if isinstance(tree, Leaf):
        part = tree.part
        return Leaf(
            laws.Spring(part.k * stiffness) if isinstance(part, laws.Spring) else laws.Dashpot(part.c * damping), ""
        )
    return type(tree)(*(scaled(own, stiffness, damping) for own in tree.own), text="-")


def shifted(dice, tree):
    """A model of which a temperature multiplies all times."""
    reference = 293.15
    temperature = float(f"{dice.between(283, 313):.5g}")
    if dice.chance(0.5):
        energy = dice.between(20, 80)
        factor = math.exp(energy * 1e3 / 8.31446261815324 * (1 / temperature - 1 / reference))
        law = (
            f'arrhenius = {{ temperature = {temperature!r}, reference = {reference!r}, energy = "{energy!r} kJ/mol" }}'
        )
    else:
        c1, c2, off = dice.between(2, 10), dice.between(80, 150), temperature - reference
        factor = 10 ** (-c1 * off / (c2 + off))
        law = f"wlf = {{ temperature = {temperature!r}, reference = {reference!r}, c1 = {c1!r}, c2 = {c2!r} }}"
    own = scaled(tree, 1.0, factor)
    own.text = f"{tree.text}, shift = {{ {law} }}"
    return own


def of_material(dice, s):
    """A pad of a material: its numbers are those of the material times area over thickness."""
    thickness, area = float(f"{dice.between(3, 6) * s.y:.6g}"), dice.spread(1e-3, 1e-1)
    modulus, viscosity = (float(f"{own * thickness / area:.6g}") for own in (s.k, dice.spread(0.05, 0.5) * s.c))
    stuff = dice.pick(kelvin(modulus, viscosity), zener(modulus, modulus, viscosity))
    own = scaled(stuff, area / thickness, area / thickness)
    name = f"stuff-{dice.own.integers(10**6)}"
    own.text = f'material = "{name}", thickness = {thickness!r}, area = {area!r}'
    own.material = f"{name} = {{ {stuff.text} }}"
    return own


def materials(tree):
    """Those that occur in a model."""
    own = [tree.material] if hasattr(tree, "material") else []
    return own + [one for branch in getattr(tree, "own", ()) for one in materials(branch)]


def linear(dice, s):
    own = of_material(dice, s) if dice.chance(0.1) else plain(dice, s)
    return shifted(dice, own) if dice.chance(0.15) and not hasattr(own, "material") else own


def plain(dice, s):
    k, c = dice.spread(0.5, 2) * s.k, lambda: dice.spread(0.03, 0.6) * s.c
    k = float(f"{k:.6g}")
    word = dice.pick("spring", "kelvin", "kelvin", "zener", "burgers", "prony", "chain", "jeffreys", "maxwell")
    if word == "spring":
        return spring(k)
    if word == "kelvin":
        return kelvin(k, c())
    if word == "zener":
        return zener(k, dice.spread(0.3, 3) * s.k, c())
    if word == "burgers":
        return burgers(2 * k, dice.spread(0.5, 3) * s.c, k, c())
    if word == "prony":
        return prony(
            k,
            [
                (dice.spread(0.02, 0.3) * s.t, dice.spread(0.2, 1) * s.k),
                (dice.spread(0.3, 3) * s.t, dice.spread(0.2, 1) * s.k),
            ],
        )
    if word == "chain":
        return kelvin_chain([(dice.spread(0.02, 0.2) * s.t, 0.5 / k), (dice.spread(0.2, 2) * s.t, 0.5 / k)])
    if word == "jeffreys":
        return Beside(spring(k), jeffreys(dice.spread(0.3, 2) * s.c, k, c()))
    return Beside(spring(k), maxwell(k, dice.spread(0.3, 2) * s.c))


def curve(dice, s):
    """Points of a curve that stiffens."""
    y, f, found = 0.0, 0.0, [(-0.5 * s.y, -0.5 * s.f), (0.0, 0.0)]
    for rise in (1.0, dice.between(0.3, 0.8), dice.between(1.2, 3)):
        step = dice.between(0.3, 0.6) * s.y
        y, f = y + step, f + rise * s.k * step
        found.append((y, f))
    found.append((y + s.y, f + 4 * s.k * s.y))
    return [(float(f"{a:.6g}"), float(f"{b:.6g}")) for a, b in found]


def elastic(dice, s):
    """A spring that is not linear."""
    f, y = dice.spread(0.4, 2) * s.f, float(f"{s.y:.6g}")
    f = float(f"{f:.6g}")
    word = dice.pick("power", "cubic", "stiffening", "table", "foam")
    if word == "power":
        n = dice.pick(1.5, 2.0, 3.0, dice.between(1.2, 2.5))
        return Leaf(laws.PowerSpring(f, y, n), f"power-spring = {{ force = {f!r}, at = {y!r}, exponent = {n!r} }}")
    if word == "cubic":
        k, k3 = dice.spread(0.2, 1) * s.k, dice.spread(0.1, 3) * s.k / s.y**2
        return Leaf(laws.CubicSpring(k, k3), f"cubic-spring = {{ stiffness = {k!r}, cubic = {k3!r} }}")
    if word == "stiffening":
        k, limit = dice.spread(0.5, 1.5) * s.k, dice.between(1.0, 3) * s.y
        return Leaf(laws.StiffeningSpring(k, limit), f"stiffening-spring = {{ stiffness = {k!r}, limit = {limit!r} }}")
    if word == "table":
        own = curve(dice, s)
        return Leaf(laws.TableSpring(own), f"table-spring = {points(own)}")
    return foam(dice, s)


def foam_numbers(dice, s):
    h, area = dice.between(1.5, 3) * s.y, dice.spread(1e-3, 1e-1)
    plateau = dice.between(0.3, 1.2) * s.f / area
    own = dict(
        modulus=dice.between(1, 3) * s.k * h / area,
        plateau=plateau,
        densification=dice.between(0.05, 0.5) * plateau,
        exponent=dice.pick(2.0, 3.0, dice.between(1.5, 3.5)),
        thickness=h,
        area=area,
    )
    return {key: float(f"{value:.6g}") for key, value in own.items()}


def foam(dice, s):
    own = foam_numbers(dice, s)
    return Leaf(laws.Foam(*own.values()), "foam = { " + ", ".join(f"{k} = {v!r}" for k, v in own.items()) + " }")


def rate_dependent(dice, s):
    f, y, v = float(f"{dice.spread(0.4, 2) * s.f:.6g}"), float(f"{s.y:.6g}"), float(f"{s.v:.6g}")
    word = dice.pick("rate", "dashpot", "dashpot")
    if word == "rate":
        a, ref, n = dice.between(0.03, 0.2), float(f"{dice.spread(0.01, 0.3) * s.v:.6g}"), dice.pick(1.0, 1.5)
        text = (
            f"rate-spring = {{ force = {f!r}, at = {y!r}, gain = {a!r}, reference-rate = {ref!r}, exponent = {n!r} }}"
        )
        return Leaf(laws.RateSpring(f, y, a, ref, n), text)
    p = dice.pick(2.0, 1.5, 3.0, 0.7, 0.5)
    strength = float(f"{dice.between(0.1, 0.5) * s.f:.6g}")
    own = Leaf(
        laws.PowerDashpot(strength, v, p), f"power-dashpot = {{ force = {strength!r}, at = {v!r}, exponent = {p!r} }}"
    )
    return Beside(spring(float(f"{s.k:.6g}")), own)


def own_contact(dice, s):
    """What never pulls by its own law."""
    word = dice.pick("hunt", "hunt", "bumper", "foam", "table")
    f, y = float(f"{dice.spread(0.4, 2) * s.f:.6g}"), float(f"{s.y:.6g}")
    gap = dice.pick(0.0, 0.0, float(f"{dice.between(0.05, 0.5) * s.y:.6g}"))
    n = dice.pick(1.5, 1.0, 2.0)
    if word == "hunt":
        c = float(f"{dice.spread(0.05, 1) / s.v:.6g}")
        text = f"hunt-crossley = {{ force = {f!r}, at = {y!r}, dissipation = {c!r}, exponent = {n!r}, gap = {gap!r} }}"
        return Leaf(laws.HuntCrossley(f, y, c, n, gap), text)
    if word == "bumper":
        e, v = dice.between(0.2, 0.95), float(f"{s.v * dice.between(0.5, 1.5):.6g}")
        text = f"bumper = {{ force = {f!r}, at = {y!r}, restitution = {e!r}, speed = {v!r}, exponent = {n!r}, gap = {gap!r} }}"
        return Leaf(laws.bumper(f, y, e, v, n, gap), text)
    if word == "table":
        loading = curve(dice, s)[1:]
        depth = loading[-1][0]
        rest, high, low = (float(f"{own * depth:.6g}") for own in (dice.between(0.05, 0.2), 0.6, 0.3))
        first = laws.Curve(loading)
        unloading = [(rest, 0.0)]
        for y, part in ((low, dice.between(0.1, 0.3)), (high, dice.between(0.4, 0.8))):
            unloading.append((y, float(f"{part * float(first.at(y)):.6g}")))
        unloading.append(loading[-1])
        return table_loop(loading, unloading)
    own, rest, q = foam_numbers(dice, s), dice.between(0, 0.4), dice.pick(1.0, 2.0, 1.5)
    words = ", ".join(f"{k} = {v!r}" for k, v in own.items())
    text = f"hysteretic-foam = {{ {words}, set = {rest!r}, unloading-exponent = {q!r} }}"
    return Leaf(laws.hysteretic_foam(laws.Foam(*own.values()), rest, q), text)


def sliding(dice, s):
    """Sliders beside and behind springs."""
    slip = lambda low=0.03, high=0.4: float(f"{dice.spread(low, high) * s.f:.6g}")
    k = lambda: float(f"{dice.spread(0.3, 3) * s.k:.6g}")
    c = float(f"{dice.spread(0.03, 0.3) * s.c:.6g}")
    word = dice.pick("guide", "jenkins", "two", "three", "elastic", "order")
    if word == "guide":
        return Beside(kelvin(k(), c), friction(slip()))
    if word == "jenkins":
        return Beside(kelvin(k(), c), Row(spring(k()), friction(slip())))
    if word == "two":
        return Beside(kelvin(k(), c), Row(spring(k()), friction(slip())), Row(friction(slip()), spring(k())))
    if word == "three":
        return Beside(
            kelvin(k(), c),
            friction(slip(0.02, 0.1)),
            Row(spring(k()), friction(slip())),
            Row(spring(k()), friction(slip())),
        )
    if word == "elastic":
        return Beside(kelvin(k(), c), Row(elastic(dice, s), friction(slip())))
    return Beside(spring(k()), Row(spring(k()), friction(slip(0.05, 0.3))), friction(slip(0.02, 0.2)), dashpot(c))


def law(dice, s, kind=None):
    if kind is None and dice.chance(0.05):
        return Row(rigid(), law(dice, s))
    kind = kind or dice.pick("linear", "linear", "elastic", "rate", "contact", "slide", "slide", "row", "gap")
    c = float(f"{dice.spread(0.03, 0.4) * s.c:.6g}")
    if kind == "linear":
        return linear(dice, s)
    if kind == "elastic":
        return Beside(elastic(dice, s), dashpot(c) if dice.chance(0.7) else spring(float(f"{0.1 * s.k:.6g}")))
    if kind == "rate":
        return rate_dependent(dice, s)
    if kind == "contact":
        return own_contact(dice, s)
    if kind == "slide":
        return sliding(dice, s)
    if kind == "row":
        # A power law alone is flat at rest: what it bears tells nothing of its place there.
        side = dashpot(c) if dice.chance(0.5) else spring(float(f"{0.3 * s.k:.6g}"))
        return Row(Beside(elastic(dice, s), side), spring(float(f"{3 * s.k:.6g}")))
    gap = float(f"{dice.between(0.1, 0.6) * s.y:.6g}")
    return Beside(linear(dice, s), Row(contact(gap), kelvin(float(f"{dice.spread(1, 10) * s.k:.6g}"), c)))
