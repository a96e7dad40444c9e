"""Errors of every public call: whatever is wrong with an argument is a pacini.Error that names it, in the words of
Python. Calls are made from the signatures, so a function that is added is tried as well."""

import functools
import inspect
import itertools
import os
import re
import types
import unittest
import warnings

import numpy as np
import pacini
import pacini.measure
from sounds import RATE, FolderTest, knocks

SOUND = knocks(0.3)
CLIP = pacini.encode(SOUND, RATE)
SWEEP = pacini.measure.sweep(duration=1.0)
TEXTURE = pacini.Texture.of_recording(knocks(1.5), RATE)

# What is never of use to a user: signatures and types of C++, the native module, names that Python does not have.
LEAKED = re.compile(
    r"incompatible function|std::|nanobind|_native|Handle\b|Invoked with|object at 0x|"
    r"positional argument|__init__|<class|could not convert|cannot be interpreted|has no attribute|"
    r"\b(?!dB\b|kHz\b)[a-z]+[A-Z]\w*"
)

# A right value for each argument that has none of its own.
RIGHT = {
    "sound": SOUND,
    "sample_rate": RATE,
    "content": CLIP,
    "reference": SOUND,
    "candidate": SOUND,
    "format": "ahap",
    "times": [0.0, 1.0, 2.0],
    "values": [0.0, 1.0, 0.0],
    "count": 2,
    "duration": 1.0,
    "start": 0.0,
    "end": 0.2,
    "time": 0.1,
    "part": CLIP,
    "semitones": 1.0,
    "ratio": 1.5,
    "passes": 2,
    "clips": [CLIP],
    "name_or_path": "lra-175",
    "low": 50.0,
    "centre": 80.0,
    "high": 120.0,
    "profile": "l5-wristband",
    "sweep": SWEEP,
    "data": CLIP.to_bytes(),
    "speed": 0.5,
    "frequencies": [50.0, 100.0],
    "block": SOUND,
    "sounds": [SOUND],
    "method": "lowpass",
}
OBJECTS = {
    pacini.Clip: CLIP,
    pacini.Profile: pacini.Profile("l5-wristband"),
    pacini.Scene: pacini.Scene([CLIP]),
    pacini.Texture: TEXTURE,
    pacini.Translator: pacini.Translator(),
    pacini.measure.Sweep: SWEEP,
}
RESPONSE = (np.geomspace(30.0, 1000.0, 60).tolist(), [0.0] * 60)
# By the function, where the same name is another thing, or the usual one takes long.
OWN = {
    "simplified": {"count": 5},
    "simplified_report": {"count": 5},
    "Scene.load": {"clips": "."},
    "Texture.render": {"duration": 0.1},
    "sweep": {"duration": 1.0, "low": 20.0, "high": 900.0, "profile": None},
    "encode": {"method": "a2vt"},
    "encode_files": {"method": "a2vt", "sample_rate": RATE},
    "convert": {"format": "ahap"},
    "Clip.to_bytes": {"format": "packed"},
    "Clip.save": {"format": "packed"},
    "Texture.of_recording": {"sound": knocks(1.5)},
    "simplify": {"method": "lagrangian", "count": 2},
    "Clip.simplified": {"method": "lagrangian", "count": 5},
    "Clip.simplified_report": {"method": "lagrangian", "count": 5},
    "Band": {},
    "measure.fit": {"profile": None},
    "write_audio": {},
    "Clip": {"name": "n"},
    "Scene": {"plays": None, "changes": ()},
}
# Results, which nobody makes, and what takes whatever Matplotlib does.
LEFT_OUT = {
    "Error",
    "FileError",
    "FileMissing",
    "ArgumentError",
    "Comparison",
    "Format",
    "Loss",
    "Method",
    "Preset",
    "RenderReport",
    "SimplifiedLane",
    "Source",
    "Texture",
    "measure.Fit",
    "measure.Level",
    "measure.Measurement",
    "measure.Section",
    "measure.Verification",
    "measure.Sweep",
    "measure.Recording",
    "Clip.plot",
}


class Nothing:
    """No argument is of this type."""

    def __repr__(self):
        return "a Nothing"


WRONG_VALUES = [
    "§",
    b"\xff",
    -1e300,
    1e300,
    float("nan"),
    float("inf"),
    -1,
    10**30,
    True,
    None,
    [],
    {},
    (),
    [Nothing()],
    {"§": 1},
    np.zeros((2, 3, 4)),
    np.array(["a"]),
    slice(1, 2),
]


def public():
    """(name, function) of all that is called; methods of an object that there is."""
    for module, prefix in ((pacini, ""), (pacini.measure, "measure.")):
        for name in module.__all__ if hasattr(module, "__all__") else vars(module):
            one = getattr(module, name)
            if (
                name.startswith("_")
                or prefix + name in LEFT_OUT
                or not callable(one)
                or not one.__module__.startswith("pacini")
                or (prefix and one.__module__ != module.__name__)
            ):
                continue
            if isinstance(one, type):
                bound = OBJECTS.get(one, one)
                for member in vars(one):
                    call = getattr(bound, member)
                    if (
                        not member.startswith("_")
                        and isinstance(call, (types.MethodType, types.FunctionType))
                        and f"{name}.{member}" not in LEFT_OUT
                    ):
                        yield f"{prefix}{name}.{member}", call
                for member in {
                    m for base in one.__mro__[1:] if base.__module__.startswith("pacini") for m in vars(base)
                }:
                    if not member.startswith("_") and member not in vars(one):
                        yield f"{prefix}{name}.{member}", getattr(bound, member)
            yield prefix + name, one


class Errors(FolderTest):
    def setUp(self):
        super().setUp()
        self.clip_file = self.folder / "clip.json"
        CLIP.save(self.clip_file)
        self.number = itertools.count()
        before = os.getcwd()  # files are named as values that are wrong elsewhere
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)

    def right(self, name, parameters):
        """Arguments of a call that is right."""
        short = name.split(".")[-1]
        own = {**OWN.get(short, {}), **OWN.get(name, {})}
        arguments = {}
        for parameter in parameters.values():
            key = parameter.name
            if key in own:
                arguments[key] = own[key]
            elif parameter.default is not parameter.empty or parameter.kind == parameter.VAR_KEYWORD:
                if (
                    key in ("profile", "method", "sample_rate")
                    and key in RIGHT
                    and name in ("encode", "compare", "translate", "Texture.of_recording", "measure.simulate")
                ):
                    arguments[key] = RIGHT[key]
            elif key in ("path", "output") and (short in ("save", "write_audio") or key == "output"):
                arguments[key] = (
                    f"{self.folder}/{next(self.number)}.{'wav' if 'udio' in name or 'Sweep' in name else 'pacb'}"
                )
            elif key == "path":
                arguments[key] = str(self.clip_file)
            elif key == "content" and short == "from_dict":
                arguments[key] = OBJECTS[getattr(pacini, name.split(".")[0])].to_dict()
            elif key == "response":
                arguments[key] = RESPONSE
            elif key == "measurement":
                arguments[key] = RESPONSE
            elif key == "recordings":
                arguments[key] = [pacini.measure.simulate(SWEEP)]
            elif name == "measure.verify" and key == "profile":
                arguments[key] = "l5-wristband"
            elif name == "compare_files":
                arguments[key] = self.folder
            else:
                self.assertIn(key, RIGHT, f"{name}: a right value of {key} is missing in this test")
                arguments[key] = RIGHT[key]
        return arguments

    def outcome(self, function, arguments):
        """The error of a call, raised or given for one of many; None if it takes the arguments."""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                result = function(**arguments)
                if inspect.isgenerator(result):
                    errors = [one for _, one in result if isinstance(one, Exception)]
                    return errors[0] if errors else None
        except Exception as error:
            return error
        return None

    def check(self, name, key, value, error):
        said = f"{name}({key}={value!r:.60}): {type(error).__name__}: {error}"
        self.assertIsInstance(error, pacini.Error, said)
        self.assertIsNone(LEAKED.search(str(error).replace(repr(value), "")), said)

    def each(self):
        for name, function in sorted(public()):
            try:
                parameters = dict(inspect.signature(function).parameters)
            except ValueError:
                continue
            yield name, function, parameters

    def test_right_calls_are_right(self):
        tried = 0
        for name, function, parameters in self.each():
            if name in (
                "read_audio",
                "convert",
                "Scene.load",
                "Profile.load",
                "Texture.load",
                "compare_files",
                "read",
                "Clip.load",
                "lint",
                "measure.analyse",
            ):
                continue  # of other files
            with self.subTest(name):
                error = self.outcome(function, self.right(name, parameters))
                self.assertIsNone(error, f"{name}: {error!r}")
                tried += 1
        self.assertGreater(tried, 40)

    def test_wrong_values_are_errors_of_pacini_in_the_words_of_python(self):
        for name, function, parameters in self.each():
            for key, parameter in parameters.items():
                if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
                    continue
                for value in [Nothing(), *WRONG_VALUES]:
                    with self.subTest(call=name, argument=key, value=repr(value)[:40]):
                        error = self.outcome(function, {**self.right(name, parameters), key: value})
                        if isinstance(value, Nothing) and key not in ("style", "ax"):
                            self.assertIsNotNone(error, f"{name}({key}=Nothing()) is taken")
                            self.check(name, key, value, error)
                            self.assertIn(key, str(error), f"{name}({key}=...) does not name it: {error}")
                        elif error is not None:
                            self.check(name, key, value, error)

    def test_misspelt_options_name_the_nearest(self):
        for name, function, parameters in self.each():
            for key, parameter in parameters.items():
                if (
                    parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL, parameter.POSITIONAL_ONLY)
                    or len(key) < 4
                ):
                    continue
                wrong = key[:1] + key[2:]
                if wrong in parameters:
                    continue
                if name in ("Translator.set", "Scene"):
                    continue
                with self.subTest(call=name, argument=wrong):
                    arguments = self.right(name, parameters)
                    error = self.outcome(function, {**arguments, wrong: arguments.get(key, 1)})
                    self.assertIsInstance(error, pacini.Error, f"{name}({wrong}=): {error!r}")
                    self.assertIn(f"did you mean {key}?", str(error))

    def test_names_of_files_stay_as_they_are(self):
        name = f"{self.folder}/MyFile.Xyz"
        for call in (
            lambda: pacini.write_audio(name, SOUND, RATE),
            lambda: CLIP.save(name),
            lambda: pacini.read_audio(name),
            lambda: pacini.Clip.load(name),
            lambda: pacini.Scene.load(name),
            lambda: pacini.Texture.load(name),
            lambda: pacini.encode(name),
            lambda: pacini.read(name),
        ):
            with self.assertRaises(pacini.Error) as caught:
                call()
            self.assertIn(name, str(caught.exception))

    def test_missing_and_too_many_arguments_are_errors_of_pacini(self):
        for name, function, parameters in self.each():
            with self.subTest(call=name):
                error = self.outcome(functools.partial(function, *range(40)), {})
                self.assertIsInstance(error, pacini.Error, f"{name}: {error!r}")
                if any(one.default is one.empty and one.kind != one.VAR_KEYWORD for one in parameters.values()):
                    self.check(name, "", "", self.outcome(function, {}))


if __name__ == "__main__":
    unittest.main()
