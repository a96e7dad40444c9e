#!/usr/bin/env python3
"""The CLAP plugin in a host of our own, beside the VST3: sound, drive, parameters, modulation, events, ports, states.

check_clap.py PLUGIN.clap PLUGIN.vst3     exit 0, 1 on a failed check, 77 when DawDreamer or Pedalboard is not there
"""

import sys
import threading
from pathlib import Path

from host_test import RATE, check, failures, skip

try:
    import dawdreamer
    import numpy as np
    import pedalboard
    from clap_host import (
        AUTOMATABLE,
        BYPASS,
        CONTINUE,
        ENUM,
        ERROR,
        INVALID,
        MODULATABLE,
        MODULATION,
        STEPPED,
        VALUE,
        Events,
        Info,
        Library,
        Plugin,
        Port,
        Process,
        Request,
        c,
        value_event,
    )
    from host_sounds import sounds
except ImportError as error:
    skip(error)

SECONDS = 1.5
SOUND = sounds()[:, : int(SECONDS * RATE)]


def active(library, **settings):
    plugin = Plugin(library)
    for name, value in settings.items():
        plugin.set(name.replace("_", " "), value)
    plugin.activate()
    return plugin


def rendered(library, sound=SOUND, settings=None, **options):
    plugin = active(library, **settings or {})
    out = plugin.render(sound, **options)
    plugin.deactivate()
    plugin.destroy()
    return out


def check_entry(library):
    described = library.descriptor()
    check("one plugin", library.factory.count(c.addressof(library.factory)) == 1 and library.descriptor(1) is None)
    features = [described.features[i] for i in range(3)]
    check(
        "it says what it is",
        (described.id, described.name, features[0], described.features[3])
        == (b"example.pacini.translator", b"Pacini", b"audio-effect", None),
    )
    factory = library.factory
    host = Plugin(library).host
    check(
        "no instance of another plugin, nor for no host",
        not factory.create(c.addressof(factory), c.byref(host), b"other")
        and not factory.create(c.addressof(factory), None, described.id),
    )
    check("no other factory", not library.entry.get_factory(b"clap.other"))
    check("entered and left again and again", all(library.entry.init(library.path) for _ in range(3)))
    for _ in range(3):
        library.entry.deinit()
    plugin = Plugin(library)
    check("an extension that it has not", not plugin.struct.get_extension(plugin.at, b"clap.note-ports"))
    plugin.destroy()


def check_sound(library, vst3):
    plugin = active(library)
    latency = plugin.call("latency", "get")
    check("a latency below 5 ms", 0 < latency < 0.005 * RATE, f"{latency} frames")
    check("a tail of a second", plugin.call("tail", "get") == RATE)
    usual = plugin.render(SOUND)
    check(
        "the sound passes bit by bit, late by the latency", np.array_equal(usual[:2, latency:], SOUND[:2, :-latency])
    )
    check(
        "the haptic output moves within full drive",
        0.05 < np.abs(usual[2]).max() <= 1.0,
        f"{np.abs(usual[2]).max():.3f}",
    )
    check("hosts go on", plugin.statuses == {CONTINUE})
    check("no output counts as constant", set(plugin.constants) == {0})

    engine = dawdreamer.RenderEngine(RATE, 512)
    other = engine.make_plugin_processor("pacini", vst3)
    other.enable_all_buses()
    names = {p["name"]: p["index"] for p in other.get_parameters_description()}

    def by_vst3(**settings):
        for name, value in settings.items():
            other.set_parameter(names[name.replace("_", " ")], value)
        main, side = (
            engine.make_playback_processor(name, part) for name, part in (("m", SOUND[:2]), ("s", SOUND[2:3]))
        )
        engine.load_graph([(main, []), (side, []), (other, ["m", "s"])])
        engine.render(SECONDS)
        return engine.get_audio()

    def same(claim, ours, theirs):
        frames = ours.shape[1] - latency
        check(claim, any(np.array_equal(theirs[:, :frames], ours[:, lag : lag + frames]) for lag in (0, latency)))

    same("sound and drive are those of the VST3, bit by bit", usual, by_vst3())
    same("so with the sidechain as source", rendered(library, settings={"Source": 1}), by_vst3(Source=0.5))
    same(
        "so for another actuator, rendered offline",
        offline(library, Source=1, Actuator=3),
        by_vst3(Source=0.5, Actuator=3 / 31),
    )
    plugin.deactivate()
    plugin.destroy()
    return usual


def offline(library, **settings):
    plugin = Plugin(library)
    check(
        "rendering offline is accepted, other ways are not",
        plugin.call("render", "set", 1) and not plugin.call("render", "set", 7) and not plugin.call("render", "hard"),
    )
    for name, value in settings.items():
        plugin.set(name, value)
    plugin.activate()
    out = plugin.render(SOUND)
    plugin.deactivate()
    plugin.destroy()
    return out


def check_blocks(library, usual):
    sound, n = SOUND[:, : RATE // 2], RATE // 2
    for block in (1, 7, 64, 1025, 8192, [1, 4096, 3, 700]):
        check(f"blocks of {block} change nothing", np.array_equal(rendered(library, sound, block=block), usual[:, :n]))
    check("in place", np.array_equal(rendered(library, in_place=True), usual))
    quiet = SOUND.copy()
    quiet[2] = 0
    mix = {"Source": 2}
    check(
        "no sidechain is a silent one",
        np.array_equal(rendered(library, settings=mix, sidechain=False), rendered(library, quiet, settings=mix)),
    )
    plugin = active(library)
    first = plugin.render(SOUND)
    plugin.reset()
    check("after a reset it is as new", np.array_equal(plugin.render(SOUND), first))
    for rate, frames in ((0.0, 64), (float("nan"), 64), (-1.0, 64), (48000.0, 0)):
        other = Plugin(library)
        check(f"{rate} Hz in blocks of {frames} is refused", not other.struct.activate(other.at, rate, 1, frames))
        other.destroy()
    for rate in (8000.0, 44100.0, 96000.0, 768000.0, 48000.0):
        plugin.deactivate()
        plugin.activate(rate)
        done = plugin.render(SOUND[:, :8000])
        check(
            f"{rate:.0f} Hz: the sound passes, and the rest is finite",
            np.isfinite(done).all()
            and np.array_equal(
                done[0, plugin.call("latency", "get") :], SOUND[0, : 8000 - plugin.call("latency", "get")]
            ),
        )
    told = [what for what, *_ in plugin.record].count("latency")
    check("hosts hear of each other latency", told == 5, told)
    check("and it is as new at the first rate", np.array_equal(active(library).render(SOUND), usual))
    main, haptic = np.ones((2, 64), np.float32), np.ones((1, 64), np.float32)
    check(
        "no ports, no channels and no frames do no harm",
        all(
            plugin.process(*ports, 0, frames) == CONTINUE
            for ports, frames in (
                (([], []), 64),
                (([None, None], [None, None]), 64),
                (([main], [main[:1], haptic]), 64),
                (([main, haptic], [main]), 64),
                (([main, haptic], [main, haptic]), 0),
            )
        ),
    )
    wide = np.ones((5, 64), np.float32)
    plugin.process([main], [wide, np.ones((3, 64), np.float32)])
    check("channels that the plugin has not are silent", not wide[2:].any())
    doubles = (Process._fields_[4][1]._type_ * 2)()
    pointers = (c.c_void_p * 2)(main.ctypes.data, main.ctypes.data)
    for buffer in doubles:
        buffer.data64, buffer.channels = c.cast(pointers, c.POINTER(c.c_void_p)), 2
    lists = Events()
    process = Process(-1, 16, None, doubles, doubles, 2, 2, c.pointer(lists.input), c.pointer(lists.output))
    check("samples of 64 bits are refused", plugin.struct.process(plugin.at, c.byref(process)) == ERROR)
    check("and so is no block", plugin.struct.process(plugin.at, None) == ERROR)
    plugin.deactivate()
    check("nothing is processed while it is not active", plugin.process([main], [main, haptic]) == ERROR)
    plugin.destroy()


def check_parameters(library, vst3):
    plugin = Plugin(library)
    known = plugin.parameters
    theirs = pedalboard.load_plugin(vst3)
    names = {p.name for p in theirs._parameters} - {"Program"}  # noqa: SLF001 - without the lists of values
    check("all parameters of VST3, and no others", len(known) == 62 and set(known) == names, set(known) ^ names)
    check("identifiers differ", len({info.id for info in known.values()}) == len(known))
    check(
        "each is in a group",
        {info.module.decode() for info in known.values()}
        == {"Sound", "Output", "Actuator", "Layers", "Character", "Events", "Gate", "Panning", "Haptic channels"},
    )
    ranges = {
        "Intensity": (-60, 24, 0),
        "Actuator": (0, 31, 0),
        "Attack": (0, 200, 1),
        "Sharpness": (-1, 1, 0),
        "Haptic channel": (1, 16, 4),
    }
    check("ranges in units", all((known[n].low, known[n].high, known[n].standard) == r for n, r in ranges.items()))
    check("each starts with its default", all(plugin.value(name) == info.standard for name, info in known.items()))
    check("all can be automated", all(info.flags & AUTOMATABLE for info in known.values()))
    check("bypass is the host's own", [n for n, info in known.items() if info.flags & BYPASS] == ["Bypass"])
    stepped = {n for n, info in known.items() if info.flags & STEPPED}
    enumerated = {n for n, info in known.items() if info.flags & ENUM}
    check(
        "choices and switches are lists of values",
        enumerated <= stepped
        and {"Source", "Actuator 8", "Bypass"} <= enumerated
        and stepped - enumerated == {"Haptic channel", "Added channels"},
        stepped - enumerated,
    )
    check(
        "what moves smoothly can be modulated, but for the strength",
        {n for n, info in known.items() if not info.flags & MODULATABLE} == stepped | {"Strength"},
    )
    wrong = []
    for name, info in known.items():
        steps = range(int(info.low), int(info.high) + 1) if name in stepped else np.linspace(info.low, info.high, 41)
        for value in steps:
            text = plugin.text(name, value)
            back = plugin.typed(name, text) if text else None
            if (
                back is None
                or plugin.text(name, back) != text
                or (name in stepped and back != value)
                or abs(back - value) > 0.006 * max(1.0, abs(value)) + 0.05
            ):
                wrong.append((name, value, text, back))
    check("every text reads back as its value", not wrong, wrong[:3])
    refused = [
        (name, words)
        for name in known
        for words in ("", "  ", "what?", "1e999", "nan", "12 apples", "99999999", "\xff")
        if plugin.typed(name, words) is not None
    ]
    check("wrong texts are refused", not refused, refused[:3])
    check(
        "units are understood",
        (plugin.typed("Release", "0.5 s"), plugin.typed("Intensity", "-6,5 dB"), plugin.typed("Bypass", "on"))
        == (500, -6.5, 1),
    )
    check(
        "texts fit into little room",
        (plugin.text("Source", 1, 5), plugin.text("Source", 1, 1), plugin.text("Source", 1, 0)) == ("Side", "", None),
    )
    check("no text for what is no number", plugin.text("Intensity", float("nan")) is None)
    value = c.c_double(3.0)
    check(
        "an identifier that is none is refused",
        not plugin.call("params", "get_value", 12345, c.byref(value))
        and not plugin.call("params", "text_to_value", 12345, b"1", c.byref(value))
        and value.value == 3.0
        and not plugin.call("params", "get_info", len(known), c.byref(Info())),
    )
    texts = {}
    for name in known:
        theirs_of_it = next(p for p in theirs._parameters if p.name == name)  # noqa: SLF001
        texts[name] = theirs_of_it.string_value.split(" ")[0] == plugin.text(name, plugin.value(name)).split(" ")[0]
    check("values have the texts of VST3", all(texts.values()), [n for n, is_same in texts.items() if not is_same][:5])
    plugin.destroy()


def check_events(library, usual):
    at, muted = 24001, ("Rumble mute", "Texture mute", "Transients mute")
    probe = Plugin(library)
    ids = {name: info.id for name, info in probe.parameters.items()}
    probe.destroy()
    changes = [(at, ids[name], 1.0, VALUE) for name in muted]
    automated = rendered(library, block=8192, events=changes)
    check(
        "automation acts from its frame on, within a block",
        np.array_equal(automated[:, :at], usual[:, :at])
        and np.array_equal(automated, rendered(library, block=[at, 100000], events=changes))
        and not automated[2, at + RATE // 4 :].any(),
    )
    softer = rendered(library, settings={"Intensity": -12})
    modulated = active(library)
    before = modulated.save()
    check(
        "a modulation sounds like the value",
        np.array_equal(modulated.render(SOUND, events=[(0, ids["Intensity"], -12.0, MODULATION)]), softer),
    )
    check("and leaves it as it was", modulated.value("Intensity") == 0 and modulated.save() == before)
    modulated.reset()
    check(
        "until the host takes it away",
        np.array_equal(modulated.render(SOUND, events=[(0, ids["Intensity"], 0.0, MODULATION)]), usual),
    )
    modulated.reset()
    check(
        "one beyond the range ends at it",
        np.array_equal(
            modulated.render(SOUND, events=[(0, ids["Intensity"], -999.0, MODULATION)]),
            rendered(library, settings={"Intensity": -60}),
        ),
    )
    nothing = [(0, ids[name], 1.0, MODULATION) for name in ("Source", "Strength", "Bypass")]
    nothing += [(0, 12345, 1.0, VALUE), (0, 12345, 1.0, MODULATION), (0, INVALID, 1.0, VALUE)]
    nothing += [
        (0, ids["Intensity"], value, kind)
        for value in (float("nan"), float("inf"), float("-inf"))
        for kind in (VALUE, MODULATION)
    ]
    check(
        "what cannot be modulated, what is unknown and what is no number changes nothing",
        np.array_equal(rendered(library, events=nothing), usual),
    )
    plugin = active(library)
    identifier = ids["Intensity"]
    strange = [
        value_event(identifier, -20, space=9),
        value_event(identifier, -20, kind=4),
        value_event(identifier, -20, size=16),
        value_event(identifier, -20, size=0),
        None,
        value_event(identifier, -20, kind=65535),
    ]
    plugin.flush(strange)
    check("other events are left alone", plugin.value("Intensity") == 0)
    lists = Events(
        [value_event(identifier, -1, 400), value_event(identifier, -2, 100), value_event(identifier, -3, 4000000000)]
    )
    out = [np.zeros((2, 512), np.float32), np.zeros((1, 512), np.float32)]
    check(
        "events out of order and behind the end count when they come",
        plugin.process([SOUND[:2], SOUND[2:3]], out, 0, 512, lists) == CONTINUE and plugin.value("Intensity") == -3,
    )
    plugin.flush([value_event(identifier, 1e300), value_event(ids["Source"], 1.4), value_event(ids["Attack"], -5)])
    check(
        "values beyond the range end at it, steps are whole",
        (plugin.value("Intensity"), plugin.value("Source"), plugin.value("Attack")) == (24, 1, 0),
    )
    rng = np.random.default_rng(5)
    # Delays that glide are read between samples, which may pass full drive by half a percent.
    names = [name for name in ids if not name.startswith("Delay") and name != "Pan law"]
    storm = [
        (
            int(rng.integers(RATE // 2)),
            ids[names[rng.integers(len(names))]],
            float(rng.normal(0, 100)),
            VALUE if rng.random() < 0.5 else MODULATION,
        )
        for _ in range(4000)
    ]
    storm.sort(key=lambda event: event[0])
    stormy = plugin.render(SOUND[:, : RATE // 2], block=1000, events=storm)
    check(
        "a storm of events stays finite and within full drive",
        np.isfinite(stormy).all() and np.abs(stormy[2]).max() <= 1.0,
    )
    check("and the host hears no echo of its own events", plugin.sent == [])
    plugin.deactivate()
    plugin.destroy()
    two = [active(library), active(library)]
    two[0].set("Intensity", -12)
    one, other = (plugin.render(SOUND) for plugin in two)
    check(
        "two instances know nothing of each other",
        np.array_equal(other, usual) and not np.array_equal(one[2], usual[2]),
    )
    bypassed = rendered(library, settings={"Bypass": 1})
    check(
        "bypassed, the sound passes and nothing is felt",
        np.array_equal(bypassed[:2], usual[:2]) and not bypassed[2].any(),
    )


def check_ports(library):
    plugin = Plugin(library)

    def seen():
        return [
            [(p.name.decode(), p.channels, p.flags, p.type, p.in_place) for p in plugin.ports(way)]
            for way in (True, False)
        ]

    check(
        "ports have names",
        seen()
        == [
            [("Sound", 2, 1, b"stereo", 0), ("Sidechain", 1, 0, b"mono", INVALID)],
            [("Sound", 2, 1, b"stereo", 0), ("Haptic", 1, 0, None, INVALID)],
        ],
        seen(),
    )
    check("no other ports", not plugin.call("audio-ports", "get", 2, True, c.byref(Port())))

    def asks(*wanted):
        requests = (Request * len(wanted))(
            *[Request(way, port, channels, None, None) for way, port, channels in wanted]
        )
        can = plugin.call("configurable-audio-ports/1", "can_apply", requests, len(wanted))
        return can, plugin.call("configurable-audio-ports/1", "apply", requests, len(wanted))

    check("eight actuators", asks((False, 1, 8)) == (True, True) and seen()[1][1][1] == 8)
    plugin.activate()
    out = plugin.render(SOUND, haptics=8)
    check(
        "each has the drive",
        all(np.array_equal(out[2], channel) for channel in out[3:]) and np.abs(out[2]).max() > 0.05,
    )
    check("not while it is active", asks((False, 1, 2)) == (False, False))
    plugin.deactivate()
    for wanted in (
        [(True, 0, 1)],
        [(False, 1, 9)],
        [(False, 1, 0)],
        [(True, 7, 1)],
        [(True, 0, 17), (False, 0, 17)],
        [(False, 1, 4000000000)],
    ):
        check(f"impossible ports are refused: {wanted}", asks(*wanted) == (False, False) and seen()[1][1][1] == 8)
    check(
        "mono",
        asks((True, 0, 1), (False, 0, 1), (False, 1, 1)) == (True, True) and seen()[0][0][1:4] == (1, 1, b"mono"),
    )
    count = plugin.call("audio-ports-config", "count")
    check(
        "configurations can be chosen",
        count == 7 and all(plugin.call("audio-ports-config", "select", i) for i in range(count)),
    )
    check("and no others", not plugin.call("audio-ports-config", "select", count))
    plugin.destroy()


def juce_base64(data):
    """JUCE's own form of MemoryBlock::toBase64Encoding()."""
    alphabet = ".ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+"
    number = int.from_bytes(data, "little")
    return f"{len(data)}." + "".join(alphabet[number >> bit & 63] for bit in range(0, 8 * len(data), 6))


def from_juce_base64(text):
    size, _, letters = text.partition(".")
    alphabet = ".ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+"
    number = sum(alphabet.index(letter) << 6 * i for i, letter in enumerate(letters))
    return (number & ((1 << 8 * int(size)) - 1)).to_bytes(int(size), "little")


def check_state(library, vst3):
    first = active(library, Intensity=-7.5, Actuator=3, Source=1, Release=123.4, Actuator_2=5)
    wanted = first.render(SOUND)
    state = first.save()
    check("a state in pieces is the same", all(first.save(most) == state for most in (1, 7, 1000)))
    check("one that cannot be written fails", first.save(0) is None)
    for most in (1 << 30, 1, 13):
        second = Plugin(library)
        check(f"it is read in pieces of {most} bytes", second.load(state, most) and second.save() == state)
        check(
            "hosts read the values anew, and record none",
            second.record.count(("rescan", 1)) == 1 and second.flush() == [] and ("flush",) not in second.record,
        )
        second.activate()
        check("and sounds the same", np.array_equal(second.render(SOUND)[2, RATE // 2 :], wanted[2, RATE // 2 :]))
        second.destroy()
    other = Plugin(library)
    other.set("Intensity", 3)
    kept = other.save()
    for what, data in (
        ("nothing", b""),
        ("half a state", state[: len(state) // 2]),
        ("noise", bytes(range(256)) * 10),
        ("another format", b'{"format": "other"}'),
        ("a newer one", b'{"format": "pacini.plugin", "version": 99}'),
    ):
        check(f"{what} is refused, and the settings stay", not other.load(data) and other.save() == kept)
    check("a stream that fails is refused", not other.load(state, 100, fails_at=300) and other.save() == kept)

    theirs = pedalboard.load_plugin(vst3)
    raw = theirs.raw_state
    begin, end = raw.index(b"<IComponent>") + 12, raw.index(b"</IComponent>")
    inside = from_juce_base64(raw[begin:end].decode())
    check("a state of the VST3 is read", other.load(inside.partition(b"\0")[0]))
    check("and is the same bytes as that of a CLAP", inside.startswith(other.save()), other.save()[:60])
    in_vst3 = state + inside[len(other.save()) :]
    changed = raw[:begin] + juce_base64(in_vst3).encode() + raw[end:]
    size = len(changed) - len(raw)
    theirs.raw_state = changed[:4] + (int.from_bytes(raw[4:8], "little") + size).to_bytes(4, "little") + changed[8:]
    again = theirs.raw_state
    back = from_juce_base64(again[again.index(b"<IComponent>") + 12 : again.index(b"</IComponent>")].decode())
    check("a state of the CLAP is read by the VST3, and written again as it was", back.startswith(state))
    for plugin in (first, other):
        plugin.destroy()


def check_threads(library):
    """The audio thread goes on while the main thread does what it may."""
    plugin = active(library)
    state, ends, statuses = plugin.save(), threading.Event(), set()

    def play():
        out = [np.zeros((2, 256), np.float32), np.zeros((1, 256), np.float32)]
        while not ends.is_set():
            statuses.add(plugin.process([SOUND[:2], SOUND[2:3]], out, 0, 256))
            if not all(np.isfinite(port).all() for port in out):
                statuses.add("not finite")

    thread = threading.Thread(target=play)
    thread.start()
    for _ in range(40):
        plugin.load(state)
        plugin.save()
        plugin.run(0.02)
    ends.set()
    thread.join()
    check("states come and go while it plays", statuses == {CONTINUE}, statuses)
    plugin.deactivate()
    plugin.destroy()
    for timers in (True, False, True):
        made = [Plugin(library, timers) for _ in range(3)]
        check(
            "each instance has a timer, if the host has any",
            [len(plugin.timers) for plugin in made] == [int(timers)] * 3,
        )
        for plugin in made:
            plugin.run(0.02)
            plugin.destroy()
        check("and none is left", not any(plugin.timers for plugin in made))


def main():
    path, vst3 = (str(Path(argument).resolve()) for argument in sys.argv[1:3])
    library = Library(path)
    check_entry(library)
    usual = check_sound(library, vst3)
    check_blocks(library, usual)
    check_parameters(library, vst3)
    check_events(library, usual)
    check_ports(library)
    check_state(library, vst3)
    check_threads(library)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
