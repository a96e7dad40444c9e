#!/usr/bin/env python3
"""LV2 and VST3 in Ardour: sidechain from one track, haptic output recorded on another; automation written, read back
and played; export against real time; sessions of other rates; values that a preset brings; a session of 50.

check_ardour.py FOLDER_OF_PLUGINS LV2RENDER     exit 0, 1 on a failed check, 77 when Ardour is not there
"""
import concurrent.futures
import contextlib
import io
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from host_test import RATE, check, failures, skip

try:
    import numpy as np
    import soundfile
    from host_sounds import sounds
except ImportError as error:
    skip(error)

HERE = Path(__file__).resolve().parent
ATTEMPTS = 4  # Ardour without a screen crashes now and then while it starts
EXPORT = "7b6a3a08-3f0d-4a55-9b53-1c1f7f3c5a10"  # as ardour_export.lua asks for it
# WAV of 32 bits, as Ardour brings it, named by the preset.
EXPORT_PRESET = f"""<?xml version="1.0" encoding="UTF-8"?>
<ExportPreset id="{EXPORT}" name="float">
  <ExportFormat id="20b4ab09-6452-4cb3-bd66-b921cdbd2942"/>
  <ExportFilename><Folder relative="1" path="export"/><Field name="timespan" enabled="1"/></ExportFilename>
</ExportPreset>
"""
EXPORTS = 10  # of 10 sessions without a plugin 4 crashed while they were exported
WITH_PLUGIN, EXPORTING, DONE = "stage: with the plugin", "stage: export", "stage: done"  # as the scripts print


def find(pattern):
    for folder in ("/usr/bin", "/usr/local/bin", "/usr/lib/ardour7", "/usr/lib/ardour8", "/usr/lib/x86_64-linux-gnu/ardour7"):
        for path in sorted(Path(folder).glob(pattern)):
            return str(path)
    return shutil.which(pattern.rstrip("*"))


LUA = find("ardour?-lua")
if not LUA:
    skip("ardour is missing")


def how_it_ended(code, text):
    """None when the script came to its end, else what went wrong."""
    if code is None:
        return "hangs"
    if code < 0:
        return f"crashes ({signal.Signals(-code).name})"
    if code != 0 or DONE not in text:
        return f"gives up (exit {code})"
    return None


def attempts(execute, script):
    """Yields before each try; `execute` returns the exit code, None after a hang, and what was printed. Ardour may fail
    to start, and is then started anew; once it has the plugin, whatever fails is the plugin's until shown otherwise.
    Exports crash without it as often as with it, and are tried again."""
    starts = exports = 0
    while starts < ATTEMPTS and exports < EXPORTS:
        yield starts + exports + 1
        code, text = execute()
        wrong = how_it_ended(code, text)
        print(f"   {script}, attempt {starts + exports + 1}: {wrong or 'done'}", flush=True)
        if wrong is None:
            return
        print("\n".join(text.splitlines()[-8:]), flush=True)
        if EXPORTING in text and DONE not in text and code is not None and code < 0:
            exports += 1
        elif WITH_PLUGIN in text:
            check(f"{script}: Ardour keeps running with the plugin", False, wrong)
            return
        else:
            starts += 1
    if exports == EXPORTS:
        check(f"{script}: Ardour exports", False, f"not in {EXPORTS} attempts")
        return
    check(f"{script}: Ardour starts", False, f"not in {ATTEMPTS} attempts")


def run(script, environment):
    def execute():
        try:
            done = subprocess.run([LUA, str(HERE / script)], env=environment, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, errors="replace", timeout=180)
        except subprocess.TimeoutExpired as error:
            return None, (error.stdout or b"").decode(errors="replace")
        if done.returncode == 0:
            (Path(environment["SESSION_DIR"]) / "said").write_text(done.stdout)
        return done.returncode, done.stdout

    return attempts(execute, script)


def check_the_check():
    """A crash with the plugin is not tried again, one before it is."""
    def tries(*ends):
        left = list(ends)
        with contextlib.redirect_stdout(io.StringIO()):
            count = len(list(attempts(lambda: left.pop(0), "script")))
        found = bool(failures)
        failures.clear()
        return count, found

    crash, fine = -signal.SIGSEGV, (0, WITH_PLUGIN + DONE)
    assert tries(fine) == (1, False)
    assert tries((crash, "starting"), fine) == (2, False)
    assert tries((crash, WITH_PLUGIN), fine) == (1, True)
    assert tries((crash, WITH_PLUGIN + DONE), fine) == (1, True)
    assert tries((None, WITH_PLUGIN), fine) == (1, True)
    assert tries((0, WITH_PLUGIN), fine) == (1, True), "an assertion of the script"
    assert tries(*[(crash, "starting")] * ATTEMPTS) == (ATTEMPTS, True)
    assert tries((crash, WITH_PLUGIN + EXPORTING), fine) == (2, False)
    assert tries((None, WITH_PLUGIN + EXPORTING), fine) == (1, True)
    assert tries((crash, WITH_PLUGIN + EXPORTING + DONE), fine) == (1, True)
    assert tries(*[(crash, WITH_PLUGIN + EXPORTING)] * EXPORTS) == (EXPORTS, True)


def tone(samples, frequency):
    """Amplitude of a tone in the middle of what is not silent."""
    heard = np.flatnonzero(np.abs(samples) > 1e-5)
    if len(heard) < RATE:
        return 0.0
    part = samples[heard[0] + RATE // 4 : heard[0] + RATE]
    t = np.arange(len(part)) / RATE
    window = np.hanning(len(part))
    return 2 * abs(np.sum(part * window * np.exp(-2j * np.pi * frequency * t))) / window.sum()


def fill(folder, contents):
    """Replaces the silence in the tracks' files; `contents` by pattern."""
    for pattern, content in contents.items():
        for path in folder.glob(pattern):
            frames = soundfile.info(str(path)).frames
            soundfile.write(str(path), np.tile(content, frames // len(content) + 1)[:frames].astype(np.float32), RATE,
                            subtype="FLOAT")


def take(session, name):
    found = sorted((session / "interchange" / "session" / "audiofiles").glob(f"*{name}*.wav"))
    return soundfile.read(str(found[-1]), dtype="float32")[0] if found else np.zeros(1, np.float32)


def shift_between(one, other, most):
    """By how many frames `other` is later, as the middle of `one` tells."""
    middle = min(len(one), len(other)) // 2
    part = one[middle : middle + 4000]
    return min(range(-most, most + 1), key=lambda d: np.abs(part - other[middle + d : middle + d + len(part)]).max())


class Apart:
    """How far `other`, `shift` frames later, is from `one` between two frames of that."""

    def __init__(self, one, other, shift, start, end, rate):
        one, other = one[start:end], other[start + shift : end + shift]
        self.frames = min(len(one), len(other))
        one, other = one[: self.frames], other[: self.frames]
        self.largest = float(np.abs(one - other).max())
        self.share = 10 * np.log10((np.mean(np.square(one - other)) + 1e-20) / np.mean(np.square(one)))
        self.level = float(np.abs(levels(one, rate) - levels(other, rate)).max())

    def __str__(self):
        return f"largest difference {self.largest:.1e} ({self.share:.0f} dB of all), levels {self.level:.3f} dB apart"


def levels(samples, rate):
    """dB of each tenth of a second."""
    blocks = samples[: len(samples) // (rate // 10) * (rate // 10)].reshape(-1, rate // 10)
    return 10 * np.log10(np.mean(np.square(blocks, dtype=np.float64), axis=1) + 1e-20)


# dB, to which Intensity falls from -6 dB. VST3 has places on the control's way, whose middle is -6 dB.
LOW = 24 - 84 * 0.5
LOW_PLACE = round(((LOW + 60) / 84) ** (np.log(0.5) / np.log(54 / 84)), 6)
FORMATS = (("LV2", "urn:pacini:translator", -6.0, LOW), ("VST3", "Pacini", 0.5, LOW_PLACE))
RATES = (RATE, 44100, 96000)
MANY = 50
# What the preset Music changes, as places on the controls' ways.
MUSIC = {"Intensity": 0.637, "Rumble": 0.621, "Texture": 0.544, "Transients": 0.544, "Transient sensitivity": 0.4,
         "Audible": 0.5}


def alike(apart):
    """The translator works at an eighth of 48 kHz, a seventh of 44.1 and a sixteenth of 96. Where in one of its frames
    playback starts counts a little, as plugin.md says."""
    return apart.share < -40 and apart.level < 0.2


def check_automation_and_rates(folder, environment, renderer):
    """Automation of Intensity at -6 dB, then down a straight line, then at -18 dB, in each format; without the line in
    sessions of other rates. Ardour's own driver without a sound card records in real time and exports as fast as it
    can."""
    exports = folder / "config" / "ardour7" / "export"
    exports.mkdir(parents=True, exist_ok=True)
    (exports / "float.preset").write_text(EXPORT_PRESET)
    sound = sounds()
    base = folder / "sounds" / "session"
    shutil.copytree(folder / "session", base)
    fill(base / "interchange" / "session" / "audiofiles",
         {"*Music*L.wav": sound[0], "*Music*R.wav": sound[1], "*SC*.wav": sound[2]})
    with concurrent.futures.ThreadPoolExecutor() as hosts:
        jobs = [hosts.submit(check_format, folder, base, of_its_own(environment, folder, kind), renderer, sound, kind,
                             name, high, low) for kind, name, high, low in FORMATS]
        jobs.append(hosts.submit(check_many, folder, of_its_own(environment, folder, "many")))
        lv2, vst3, _ = (job.result() for job in jobs)
    if failures:
        return
    for rate in RATES:
        # Until the line starts, whose way is that of each format's control.
        apart = Apart(lv2[rate], vst3[rate], 0, rate // 2, rate, rate)
        check(f"{rate} Hz: LV2 and VST3 are felt alike", alike(apart), apart)


def of_its_own(environment, folder, name):
    """For a host that runs beside others: its own settings, with what was scanned."""
    config = folder / f"config{name}"
    shutil.copytree(folder / "config", config)
    return dict(environment, XDG_CONFIG_HOME=str(config))


def check_format(folder, base, environment, renderer, sound, kind, name, high, low):
    """Returns the haptic signal that was exported, by rate."""
    felt = {}
    for rate in RATES:
        points = [(0, high), (RATE, high)] + ([(2 * RATE, low), (3 * RATE, low)] if rate == RATE else [])
        made = folder / f"automated{kind}" / "session"
        session = folder / f"{kind}{rate}" / "session"
        here = dict(environment, SESSION_DIR=str(made), PLUGIN_ID=name, PLUGIN_KIND=kind, LABEL="Intensity",
                    EVENTS=" ".join(f"{at} {value}" for at, value in points))
        for _ in run("ardour_automate.lua", here):
            shutil.rmtree(made, ignore_errors=True)
            shutil.copytree(base, made)
        if failures:
            return felt
        project = made / "pacini.ardour"
        project.write_text(project.read_text().replace(f'sample-rate="{RATE}"', f'sample-rate="{rate}"', 1))
        here.update(SESSION_DIR=str(session), RATE=str(rate), FRAMES=str(int(3.2 * rate)))
        for _ in run("ardour_export.lua", here):
            shutil.rmtree(session, ignore_errors=True)
            shutil.copytree(made, session)
        if failures:
            return felt
        felt[rate] = check_session(f"{kind}, {rate} Hz", session, rate, points)
        if rate == RATE:
            check_levels(f"{kind}, {rate} Hz", felt[rate])
        elif Path(renderer).exists():
            scratch = folder / f"rendered{kind}"
            scratch.mkdir(exist_ok=True)
            apart = min((one_rendered(renderer, scratch, environment, sound, rate, felt[rate], start)
                         for start in range(rate // 6000)), key=lambda each: each.share)
            check(f"{kind}, {rate} Hz: it plays as in another host of this rate", alike(apart), apart)
    return felt


def check_many(folder, environment):
    """A session of MANY instances, in turns LV2 and VST3, each with a value of its own."""
    session = folder / "many" / "session"
    here = dict(environment, SESSION_DIR=str(session), KINDS=" ".join(f"{kind}={name}" for kind, name, *_ in FORMATS))
    for _ in run("ardour_many.lua", dict(here, MAKE=str(MANY))):
        shutil.rmtree(session, ignore_errors=True)
    if not failures:
        for _ in run("ardour_many.lua", here):
            pass
    if failures:
        return
    said = [line.split() for line in (session / "said").read_text().splitlines()]
    tracks = [(float(line[1]), float(line[2])) for line in said if line[:1] == ["track"]]
    played, load = (next(float(line[1]) for line in said if line[:1] == [what]) for what in ("played", "load"))
    check(f"a session of {MANY} opens with all of them, and plays", len(tracks) == MANY and played > RATE,
          f"{len(tracks)}, {played / RATE:.1f} s, load of the host {load:.0f} %")
    vst3, lv2 = tracks[::2], tracks[1::2]
    values = [value for value, _ in vst3]
    check(f"each VST3 of {MANY} has its own value", np.allclose(values, 0.3 + np.arange(1, MANY, 2) / 100, atol=1e-4),
          values[:3])
    # Tracks in turns have the noise of two pairs of inputs.
    steps = [one[1] - other[1] for one, other in zip(lv2, lv2[2:])]
    check(f"each LV2 of {MANY} is felt at its own value", np.allclose(steps, 2, atol=0.3), [round(s, 2) for s in steps[:3]])
    check(f"and each VST3 of {MANY}", all(one[1] < other[1] - 0.5 for one, other in zip(vst3, vst3[2:])),
          [round(level, 1) for _, level in vst3[:6]])


def check_session(claim, session, rate, points):
    """What the session was read as, and its export against what it recorded. Returns the haptic signal exported."""
    said = (session / "said").read_text().splitlines()
    read = [(int(line.split()[2]), float(line.split()[3])) for line in said if line.startswith("event Intensity ")]
    due = [(at * rate // RATE, value) for at, value in points]
    same = len(read) == len(due) and all(one[0] == two[0] and abs(one[1] - two[1]) < 1e-5
                                         for one, two in zip(read, due))
    check(f"{claim}: automation is read back as it was written", same, read)
    both, exported_rate = soundfile.read(str(session / "export" / "both.wav"), dtype="float32")
    check(f"{claim}: the session has the rate", exported_rate == rate and f"rate {rate}" in said, exported_rate)
    for what, exported, recorded in (("haptic signal", both[:, 0], take(session, "HapticRec")),
                                     ("sound", both[:, 1], take(session, "MainRec"))):
        shift = shift_between(exported, recorded, 3000)
        # Playback in real time fades in, which the translation still knows for a quarter of a second; it may have been
        # stopped before the export's end.
        end = min(len(recorded) - shift - rate // 5, 5 * rate // 2)
        apart = Apart(exported, recorded, shift, rate // 4, end, rate)
        same = apart.largest < 1e-6 if what == "sound" or rate == RATE else alike(apart)
        check(f"{claim}: the {what} is exported as in real time", same and apart.frames > 1.9 * rate,
              f"{apart}, in {apart.frames} frames, {shift} later")
    return both[:, 0]


def check_levels(claim, felt):
    def level(start, end):
        return levels(felt[int(start * RATE) : int(end * RATE)], RATE).mean()

    loud, quiet, middle = level(0.5, 1), level(2.5, 3), level(1.45, 1.55)
    check(f"{claim}: what is felt follows the automation", abs((loud - quiet) - (-6 - LOW)) < 0.5,
          f"{quiet - loud:.2f} dB, written {LOW + 6:.2f} dB")
    check(f"{claim}: and is in between on the way", quiet + 1 < middle < loud - 1, f"{middle - loud:.2f} dB")


def one_rendered(renderer, folder, environment, sound, rate, felt, lead):
    """How far the haptic signal of the LV2 in the host on lilv is from what is felt, at -6 dB, where the sound starts
    `lead` frames late."""
    padded = np.concatenate([np.zeros((len(sound), lead), np.float32), np.tile(sound, (1, 5))], axis=1)
    source, made = folder / "in", folder / "out"
    np.ascontiguousarray(padded.T).tofile(source)
    subprocess.run([renderer, "urn:pacini:translator", str(rate), "1024", str(source), str(made),
                    "--set", "urn:pacini:translator:intensity=-6"],
                   env=environment, check=True, timeout=120, capture_output=True)
    played = np.fromfile(made, dtype=np.float32).reshape(-1, 3)[lead:, 2]
    shift = shift_between(felt, played, 400)  # Ardour makes good for the latency
    return Apart(felt, played, shift, rate // 2, 5 * rate // 2, rate)


def check_sidechain(folder, environment, kind, name, source):
    session = folder / kind / "session"  # of the same name, which its folders bear
    here = dict(environment, SESSION_DIR=str(session), PLUGIN_ID=name, PLUGIN_KIND=kind, SOURCE=source)
    for _ in run("ardour_play.lua", here):
        shutil.rmtree(session, ignore_errors=True)
        shutil.copytree(folder / "session", session)
    if failures:
        return
    felt, heard = take(session, "HapticRec"), take(session, "MainRec")
    tones = {f: round(float(tone(felt, f)), 3) for f in (80, 240, 150)}
    if source:
        check(f"{kind}: the sidechain's tone is felt, and only that", tones[150] > 0.1
              and max(tones[80], tones[240]) < 0.01, str(tones))
    else:
        check(f"{kind}: both channels of the sound are felt, the sidechain is not",
              min(tones[80], tones[240]) > 0.05 and tones[150] < 0.01, str(tones))
    check(f"{kind}: the sound passes", abs(tone(heard, 80) - 0.25) < 0.01 and tone(heard, 150) < 0.001,
          f"{tone(heard, 80):.3f}")
    if kind == "VST3":  # this host asks no property of an LV2 for its value
        check_values((session / "said").read_text())


def check_values(said):
    """What the host shows of the controls before and after it has loaded the preset Music."""
    values = {}
    for line in said.splitlines():
        when, label, value, standard = (line.split("\t") + ["", "", ""])[:4]
        if when in ("loaded", "preset"):
            values.setdefault(when, {})[label] = (float(value), float(standard))
    loaded, preset = values.get("loaded", {}), values.get("preset", {})
    moved = {label for label, (value, standard) in loaded.items() if abs(value - standard) > 1e-5}
    check("VST3: the host shows every value that the plugin starts with", len(loaded) == 62 and moved == {"Source"},
          f"{len(loaded)}, others than the default: {moved}")
    changed = {label: round(preset[label][0], 3) for label in preset if abs(preset[label][0] - loaded[label][0]) > 1e-5}
    check("VST3: the host shows what its preset changes, and nothing else", changed == MUSIC, changed)


def main():
    plugins, renderer = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        lv2 = [str(p) for p in [plugins / "LV2", *sorted(Path("/usr/lib").glob("*/lv2")), Path("/usr/lib/lv2")]]
        environment = dict(os.environ, HOME=str(folder), XDG_CONFIG_HOME=str(folder / "config"),
                           SESSION_DIR=str(folder / "session"), LV2_PATH=os.pathsep.join(lv2),
                           VST3_PATH=str(plugins / "VST3"), RATE=str(RATE))
        scanner = find("ardour-vst3-scanner*")
        if scanner:
            scanned = subprocess.run([scanner, "-f", str(plugins / "VST3" / "Pacini.vst3")], timeout=120,
                                     env=dict(environment, LD_LIBRARY_PATH=str(Path(scanner).parent)),
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            check("Ardour scans the VST3", scanned.returncode == 0)
        check_the_check()
        for _ in run("ardour_make.lua", environment):
            shutil.rmtree(folder / "session", ignore_errors=True)
        files = folder / "session" / "interchange" / "session" / "audiofiles"
        fill(files, {pattern: 0.25 * np.sin(2 * np.pi * frequency * np.arange(RATE) / RATE)
                     for pattern, frequency in (("*Music*L.wav", 80), ("*Music*R.wav", 240), ("*SC*.wav", 150))})
        check("Ardour makes a session", len(list(files.glob("*.wav"))) == 3)
        if failures:
            return 1

        with concurrent.futures.ThreadPoolExecutor() as hosts:
            # The LV2's settings are no control ports, which is all that the script can set.
            for job in [hosts.submit(check_sidechain, folder, of_its_own(environment, folder, f"play{kind}"), kind, name,
                                     "" if kind == "LV2" else "0.5") for kind, name, *_ in FORMATS]:
                job.result()
        if not failures:
            check_automation_and_rates(folder, environment, renderer)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
