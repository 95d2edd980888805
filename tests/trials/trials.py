"""The trials: each has a name that makes it again, a thing that is tried (a Mechanism or a text) and says what is wrong with it."""

import pathlib
import random
import re
import zlib

import back
import extremes
import held
import judges
import kills
import mutations
import relatives
import renamed
import split
import wings
from further import Further, curved_mechanism, further_mechanism, rough_further
from generator import INTEGRATORS, Generator, mechanism, rough_mechanism
from mechanism import Mechanism
from outline import render
from program import LIMIT, Run
from flown import Mirror, Rotor, compare_rotors
from shells import Sheller, edged_mechanism, shelled_mechanism
from surfaces import compare_panels, compare_sections, judge_section, panel, round_off, section, spoilt_mesh
from touching import Group, Toucher, pressed_mechanism, rough_touching, touching_mechanism
from world import World

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Trial:
    """complaints(program, thing) judges the thing, or a smaller one."""

    worst_step = float("nan")  # energy that the worst step of a motion misses, relative

    def __init__(self, name, thing):
        self.name, self.thing = name, thing

    def text(self, thing):
        return thing.text_here() if isinstance(thing, Mechanism) else thing


class MechanismTrial(Trial):
    """One model, judged by itself."""

    def complaints(self, program, thing):
        run = Run(program, thing.text_here())
        self.code, self.seconds = run.code, run.seconds
        if thing is self.thing:
            self.worst_step = judges.worst_step(thing, run, World())
        return judges.all_of(thing, run, World())


class RoughTrial(Trial):
    """A drawing with wrong lengths: it is assembled, and what is joined stays together, or there is a reason."""

    def complaints(self, program, thing):
        run = Run(program, thing.text_here())
        self.code, self.seconds = run.code, run.seconds
        return [*judges.outcome(run), *judges.readable(run), *judges.assembled(thing, run)]


class RelativeTrial(Trial):
    """Two runs in two worlds; what Newton's method leaves is amplified by ten steps to 1e-10 or so. Of energies ten times, of
    frequencies a hundred times the tolerance is allowed."""

    def __init__(self, name, thing, world, tolerance=1e-8):
        super().__init__(name, thing)
        self.world, self.tolerance = world, tolerance

    def complaints(self, program, thing):
        first, second = Run(program, thing.text_here()), Run(program, thing.text(self.world))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        return [*judges.outcome(second), *relatives.compare(thing, first, second, self.world, self.tolerance)]


class PlacedTrial(RelativeTrial):
    """With friction. Of rows that say the same, turned axes choose others to be left out; these hold at the ends of steps, and in stages
    to the order of the scheme alone, which friction feels (placed-turned 47: 5e-5 of the speed, and 64 times less with a quarter of the
    step). Such a difference must go away with shorter steps."""

    def complaints(self, program, thing):
        said = super().complaints(program, thing)
        if not said or not re.search("redundant +[1-9]", Run(program, thing.text_here(), "--check").output):
            return said
        seconds = self.seconds
        said = super().complaints(program, thing.with_(steps=4 * thing.steps, step=thing.step / 4))
        self.seconds += seconds
        return said


class ShelledRelativeTrial(RelativeTrial):
    """Steps that find no solution are halved, which round-off may decide: such runs are not compared."""

    def complaints(self, program, thing):
        first, second = Run(program, thing.text_here()), Run(program, thing.text(self.world))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        if first.has_halved_steps() or second.has_halved_steps():
            return list(judges.outcome(second))
        return [*judges.outcome(second), *relatives.compare(thing, first, second, self.world, self.tolerance)]


class NamedTrial(Trial):
    """The same model with hostile names: equal to the last bit, in tables and in frequencies."""

    def __init__(self, name, thing, seed):
        super().__init__(name, thing)
        self.seed = seed

    def complaints(self, program, thing):
        text = thing.text_here()
        first, second = Run(program, text), Run(program, renamed.with_hostile_names(text, random.Random(f"names {self.seed}")))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        said = [*judges.outcome(second), *renamed.compare(first, second, 0.0)]
        if "modes" in first.tables and "modes" in second.tables:
            said += relatives.compare_modes(first.tables["modes"], second.tables["modes"], World(), 1e-12)
        # as many warnings, whoever is named in them
        n_warnings = [run.output.count("arning") for run in (first, second)]
        if n_warnings[0] != n_warnings[1]:
            said.append(f"{n_warnings[0]} warnings become {n_warnings[1]}: {second.output[-500:]}")
        return said


class TwiceTrial(Trial):
    """A model and a second copy of it that knows nothing of the first; of motions, as modes come in pairs then."""

    def complaints(self, program, thing):
        text = thing.text_here()
        first, second = Run(program, text), Run(program, renamed.with_a_second_copy(text))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        return [*judges.outcome(second), *renamed.compare(first, second, 1e-8)]


class JudgedTrial(Trial):
    """A mechanism of which judge(program, thing) gives the runs, and what is wrong."""

    def __init__(self, name, thing, judge):
        super().__init__(name, thing)
        self.judge = judge

    def complaints(self, program, thing):
        runs, said = self.judge(program, thing)
        self.code, self.seconds = runs[0].code if runs else None, sum(run.seconds for run in runs)
        return said


class ClosedTrial(Trial):
    """A wing or a rotor beside its closed form, or something else that judges itself."""

    def text(self, thing):
        return thing.text()

    def complaints(self, program, thing):
        runs, said = thing.complaints(program)
        self.code, self.seconds = runs[0].code, sum(run.seconds for run in runs)
        return said


class KillTrial(Trial):
    def text(self, thing):
        return thing.text()

    def complaints(self, program, thing):
        said = thing.complaints(program)
        self.code, self.seconds = -1 if thing.code is None else thing.code, thing.seconds
        return said


class TextTrial(Trial):
    def __init__(self, name, thing, *arguments):
        super().__init__(name, thing)
        self.arguments = arguments

    def complaints(self, program, thing):
        run = Run(program, thing, *self.arguments)
        self.code, self.seconds = run.code, run.seconds
        return [*judges.outcome(run), *judges.readable(run)]


class PanelTrial(Trial):
    """A panel and the same in another world, or with its normal on the other side."""

    def __init__(self, name, thing, world, backwards=False):
        super().__init__(name, thing)
        self.world, self.backwards = world, backwards

    def text(self, thing):
        return thing.text(World())

    def complaints(self, program, thing):
        first, second = Run(program, thing.text(World())), Run(program, thing.text(self.world, self.backwards))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        return [*judges.outcome(first), *judges.outcome(second), *compare_panels(thing, first, second, self.world, 1e-6)]


class FlownTrial(Trial):
    """A rotor in air and the same in another world. Steps without solution are halved, which round-off may decide: not compared."""

    def __init__(self, name, thing, world):
        super().__init__(name, thing)
        self.world = world

    def text(self, thing):
        return thing.text(World())

    def complaints(self, program, thing):
        first, second = Run(program, thing.text(World())), Run(program, thing.text(self.world))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        said = [*judges.outcome(first), *judges.outcome(second)]
        if first.has_halved_steps() or second.has_halved_steps():
            return said
        return [*said, *compare_rotors(thing, first, second, self.world, 1e-6)]


class SectionTrial(Trial):
    """A section and the same in other units, turned and moved across its beam."""

    def __init__(self, name, thing, world, angle, place):
        super().__init__(name, thing)
        self.world, self.angle, self.place = world, angle, place

    def text(self, thing):
        return thing.text(World())

    def complaints(self, program, thing):
        first = Run(program, thing.text(World()))
        second = Run(program, thing.text(self.world, self.angle, self.place))
        self.code, self.seconds = first.code, first.seconds + second.seconds
        return [*judges.outcome(first), *judges.outcome(second), *judge_section(first), *judge_section(second),
                *compare_sections(first, second, self.world, self.angle, self.place, min(1e-5, max(1e-6, round_off(thing))))]


class MeshTrial(Trial):
    """A file of a mesh with mistakes."""

    def __init__(self, name, model, file, mesh):
        super().__init__(name, mesh)
        self.model, self.file = model, file

    def complaints(self, program, thing):
        run = Run(program, self.model, files={self.file: thing})
        self.code, self.seconds = run.code, run.seconds
        return [*judges.outcome(run), *judges.readable(run)]


def panel_trials(seed):
    thing = panel(seed)
    yield PanelTrial(f"panel-turned {seed}", thing, relatives.turned(Sheller(f"turned {seed}")))
    yield PanelTrial(f"panel-units {seed}", thing, World(**relatives.UNITS[seed % len(relatives.UNITS)]))
    yield PanelTrial(f"panel-backwards {seed}", thing, World(), True)


def section_trials(seed):
    thing, chance = section(seed), random.Random(f"place {seed}")
    size = max(value for _, value, *dimension in thing.entries if dimension)
    place = tuple(chance.uniform(-1, 1) * size for _ in range(2))
    yield SectionTrial(f"section-turned {seed}", thing, World(), chance.uniform(-3, 3), place)
    yield SectionTrial(f"section-units {seed}", thing, World(**relatives.UNITS[seed % len(relatives.UNITS)]), 0.0, (0.0, 0.0))


def flown_trials(seed):
    rotor = Rotor(seed)
    yield FlownTrial(f"flown-turned {seed}", rotor, relatives.turned(Sheller(f"turned {seed}")))
    yield FlownTrial(f"flown-units {seed}", rotor, World(**relatives.UNITS[seed % len(relatives.UNITS)]))
    yield FlownTrial(f"flown-mirrored {seed}", rotor, Mirror())


def mesh_trial(seed):
    return MeshTrial(f"mesh {seed}", *spoilt_mesh(seed))


def spoilt_trial(seed):
    """A panel or a section with one to three mistakes."""
    chance = random.Random(f"spoilt {seed}")
    thing = chance.choice((panel, section))(chance.randrange(10**6))
    return TextTrial(f"spoilt {seed}", mutations.mutant(chance, thing.text(World())))


def mechanism_trial(seed, integrator=None):
    model = mechanism(seed)
    if integrator:
        model.stages, model.radius = integrator
    return MechanismTrial(f"mechanism {seed}" + (f" s={model.stages} radius={model.radius:g}" if integrator else ""), model)


def touching_trial(seed):
    return MechanismTrial(f"touching {seed}", touching_mechanism(seed))


def pressed_trial(seed):
    return MechanismTrial(f"pressed {seed}", pressed_mechanism(seed))


def placed_trials(seed):
    """What slides, touches and rubs, turned and in another unit: a few steps, as contacts amplify. Stiff balls at beams take a
    thousand steps, whose sizes round-off decides."""
    model = touching_mechanism(seed).with_(steps=5, newton=1e-13, analyses=("dynamic",))
    if any(isinstance(contact, Group) and contact.beams for contact in model.contacts):
        return
    model.radius = 0.5 if model.stages == 1 else model.radius
    yield PlacedTrial(f"placed-turned {seed}", model, relatives.turned(Toucher(seed)), 1e-5)
    yield PlacedTrial(f"placed-units {seed}", model, World(**relatives.UNITS[seed % len(relatives.UNITS)]), 1e-5)


def further_trial(seed):
    return MechanismTrial(f"further {seed}", further_mechanism(seed))


def curved_trial(seed):
    return MechanismTrial(f"curved {seed}", curved_mechanism(seed))


def further_relatives(seed):
    """The same kinds turned and in another unit: few steps, as what leaves and rattles amplifies."""
    for name, model, tolerance in (("further", further_mechanism(seed), 1e-5), ("curved", curved_mechanism(seed), 1e-6)):
        model = model.with_(steps=5, newton=1e-13)
        model.radius = 0.5 if model.stages == 1 else model.radius
        yield ShelledRelativeTrial(f"{name}-turned {seed}", model, relatives.turned(Further(f"turned {seed}")), tolerance)
        yield ShelledRelativeTrial(f"{name}-units {seed}", model, World(**relatives.UNITS[seed % len(relatives.UNITS)]), tolerance)


def shelled_trial(seed):
    return MechanismTrial(f"shelled {seed}", shelled_mechanism(seed))


def edged_trial(seed):
    return MechanismTrial(f"edged {seed}", edged_mechanism(seed))


def edged_relatives(seed):
    """The same turned and in another unit, for a short time."""
    model = edged_mechanism(seed).with_(steps=5, newton=1e-13)
    model.step /= 5
    model.radius = 0.5 if model.stages == 1 else model.radius
    yield ShelledRelativeTrial(f"edged-turned {seed}", model, relatives.turned(Sheller(f"turned {seed}")), 1e-7)
    yield ShelledRelativeTrial(f"edged-units {seed}", model, World(**relatives.UNITS[seed % len(relatives.UNITS)]), 1e-7)


def shelled_relatives(seed):
    """Shells turned and in another unit, for a short time."""
    model = shelled_mechanism(seed).with_(steps=5, newton=1e-13)
    model.step /= 5
    model.radius = 0.5 if model.stages == 1 else model.radius
    yield ShelledRelativeTrial(f"shelled-turned {seed}", model, relatives.turned(Sheller(f"turned {seed}")), 1e-7)
    yield ShelledRelativeTrial(f"shelled-units {seed}", model, World(**relatives.UNITS[seed % len(relatives.UNITS)]), 1e-7)


def relative_trials(seed):
    """Turned, and in one other unit; smooth motions over a short time, so that little is amplified."""
    generator = Generator(seed)
    generator.stops = False
    model = generator.mechanism().with_(steps=10, newton=1e-13)
    model.radius = 0.5 if model.stages == 1 else model.radius
    yield RelativeTrial(f"turned {seed}", model, relatives.turned(generator))
    units = relatives.UNITS[seed % len(relatives.UNITS)]
    name = " ".join(f"{key}={value:g}" for key, value in units.items() if value != 1)
    yield RelativeTrial(f"units {seed} {name}", model, World(**units))


def named_trials(seed):
    """Other names, and a second copy, of smooth motions over a short time."""
    generator = Generator(seed)
    generator.stops = False
    model = generator.mechanism().with_(steps=10, newton=1e-13)
    yield NamedTrial(f"named {seed}", model, seed)
    model = model.with_(analyses=("dynamic",))
    model.radius = 0.5 if model.stages == 1 else model.radius
    yield TwiceTrial(f"twice {seed}", model)


def held_trial(seed):
    return JudgedTrial(f"held {seed}", held.held_mechanism(seed), held.complaints)


def held_rotor_trial(seed):
    return ClosedTrial(f"held-rotor {seed}", held.Flown(seed))


def split_trial(seed):
    return JudgedTrial(f"split {seed}", split.whole_mechanism(seed), lambda program, thing: split.complaints(program, thing, seed))


def back_trial(seed):
    return JudgedTrial(f"back {seed}", back.conservative_mechanism(seed), back.complaints)


def closed_trials(seed):
    for kind, thing in wings.closed_forms(seed).items():
        yield ClosedTrial(f"{kind} {seed}", thing)


def kill_trial(seed):
    return KillTrial(f"kill {seed}", kills.Killed(seed))


def shipped_models():
    """Small models of the repository that name no other file."""
    for path in sorted((ROOT / "prm").rglob("*.prm")):
        text = path.read_text()
        if len(text) < 6000 and not re.search(r"^\s*(include|set (File|Model)\b)|= study", text, re.M):
            yield text


def mutant_trial(seed):
    """Generated models are run, shipped ones checked."""
    chance = random.Random(f"mutant {seed}")
    if chance.random() < 0.5:
        model = mechanism(chance.randrange(1000)).with_(steps=3)
        return TextTrial(f"mutant {seed}", mutations.mutant(chance, model.text_here()))
    return TextTrial(f"mutant {seed}", mutations.mutant(chance, chance.choice(list(shipped_models()))), "--check")


def extreme_trials(program):
    for name, tree in extremes.models(program):
        yield TextTrial(f"extreme {name}", render(tree))


def short(program):
    """What ctest runs: the same always."""
    for seed in range(100, 130):
        yield mechanism_trial(seed)
    for seed in range(100, 112):
        yield touching_trial(seed)
    for seed in range(4):
        yield from placed_trials(seed)
        yield RoughTrial(f"rough-touching {seed}", rough_touching(seed))
    for seed in range(6):
        yield from relative_trials(seed)
    for seed in range(4):
        yield from named_trials(seed)
    for seed in range(14):
        yield mutant_trial(seed)
    for seed in range(14):
        yield RoughTrial(f"rough {seed}", rough_mechanism(seed))
    for seed in range(8):
        yield shelled_trial(seed)
    for seed in range(3):
        yield from shelled_relatives(seed)
    for seed in range(200, 204):
        yield further_trial(seed)
    yield curved_trial(200)
    yield RoughTrial("rough-further 200", rough_further(200))
    yield list(panel_trials(0))[-1]
    yield next(section_trials(0))
    yield from list(flown_trials(4))[1:]
    for seed in range(5):
        yield held_trial(seed)
        yield split_trial(seed)
        yield back_trial(seed)
    for seed in range(3):
        yield from closed_trials(seed)
        yield held_rotor_trial(seed)
    for seed in 0, 1, 3, 6, 11:  # of all jobs and signals; rotors take longer
        yield kill_trial(seed)
    for seed in range(2):
        yield mesh_trial(seed)
        yield spoilt_trial(seed)
    # chosen by their names, so that an entry more in the catalogue leaves the others as they are
    yield from sorted(extreme_trials(program), key=lambda trial: zlib.crc32(trial.name.encode()))[:14]


def endless(program, start):
    """What contrib/trials runs, until its time is over: new seeds, and all extremes in an order of their own."""
    everything = list(extreme_trials(program))
    random.Random(start).shuffle(everything)
    seed = start
    while True:
        for integrator in INTEGRATORS:
            yield mechanism_trial(seed, integrator)
        yield from (touching_trial(10 * seed + k) for k in range(10))
        yield from relative_trials(seed)
        yield from placed_trials(seed)
        for k in range(5):
            yield from named_trials(10 * seed + k)
        for k in range(5):
            yield held_trial(10 * seed + k)
            yield split_trial(10 * seed + k)
            yield back_trial(10 * seed + k)
        for k in range(3):
            yield from closed_trials(10 * seed + k)
            yield held_rotor_trial(10 * seed + k)
        yield kill_trial(seed)
        yield from (further_trial(10 * seed + k) for k in range(10))
        yield from (curved_trial(10 * seed + k) for k in range(3))
        yield from further_relatives(seed)
        yield from (RoughTrial(f"rough-further {10 * seed + k}", rough_further(10 * seed + k)) for k in range(5))
        yield from (pressed_trial(10 * seed + k) for k in range(5))
        yield from (shelled_trial(10 * seed + k) for k in range(5))
        yield from (edged_trial(10 * seed + k) for k in range(3))
        yield from edged_relatives(seed)
        for k in range(4):
            yield from flown_trials(10 * seed + k)
        yield from shelled_relatives(seed)
        for k in range(3):
            yield from panel_trials(10 * seed + k)
            yield from section_trials(10 * seed + k)
        yield from (mesh_trial(10 * seed + k) for k in range(10))
        yield from (spoilt_trial(10 * seed + k) for k in range(10))
        yield from (RoughTrial(f"rough-touching {10 * seed + k}", rough_touching(10 * seed + k)) for k in range(5))
        yield from (mutant_trial(10 * seed + k) for k in range(10))
        yield from (RoughTrial(f"rough {10 * seed + k}", rough_mechanism(10 * seed + k)) for k in range(10))
        yield from (everything.pop() for _ in range(min(10, len(everything))))
        seed += 1


def motions(start, n):
    """n runs of mechanisms with all integrators in turn, for statistics."""
    for k in range(n):
        yield mechanism_trial(start + k // len(INTEGRATORS), INTEGRATORS[k % len(INTEGRATORS)])


def is_slow(trial):
    """A trial of a sound model that takes half of what is allowed."""
    return trial.seconds > LIMIT / 2
