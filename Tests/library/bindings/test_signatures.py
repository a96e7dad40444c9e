"""The functions that bindings declare themselves take what those of pacini.h take: most of what is wrong there would
seem to work on one machine and fail on another."""
import re
import unittest

from bindings import BINDINGS, declarations

HANDLES = ["clip", "texture", "engine", "play", "controller"]
KINDS = {
    "u32": {"uint32_t", "u32", "uint"},
    "i32": {"int32_t", "int", "pacini_result", "i32", "c_int"},
    "u64": {"uint64_t", "ulong", "u64"},
    "i64": {"int64_t", "i64", "long"},
    "f64": {"double", "f64"},
    "size": {"size_t", "usize", "UIntPtr"},
    "none": {"void", ""},
    **{handle: {f"pacini_{handle}"} for handle in HANDLES},
}


def kind(written):
    """Of a type in C, koffi's C, Rust or C#, with or without the name of the argument."""
    if re.search(r"[*\[]|\b(ref|out|IntPtr)\b", written):
        handle = re.search(rf"\bpacini_({'|'.join(HANDLES)})\b", written)
        return f"pointer to {handle[1]}" if handle else "pointer"
    word = next((word for word in re.findall(r"\w+", written) if word != "const"), "")
    found = [kind for kind, words in KINDS.items() if word in words]
    return found[0] if found else f"unknown: {written}"


def functions(text, pattern):
    """Name to kinds of the result and of the arguments, of the groups name, result and arguments."""
    found = {}
    for match in re.finditer(pattern, text, re.S):
        arguments = [argument for argument in match["arguments"].split(",") if argument.strip() not in ("", "void")]
        found[match["name"]] = [kind(match["result"] or ""), *map(kind, arguments)]
    return found


def of_header():
    return functions(declarations(), r"(?:^|[;{}]) (?P<result>[\w *]+?) (?P<name>pacini_\w+) \( (?P<arguments>[^)]*)\) (?=;)")


class Signatures(unittest.TestCase):
    def compare(self, bound, minimum=29):
        header = of_header()
        self.assertGreaterEqual(len(header), 30)
        self.assertGreaterEqual(len(bound), minimum)
        for name, signature in bound.items():
            self.assertEqual(signature, header.get(name), name)

    def test_csharp(self):
        text = (BINDINGS / "csharp/Runtime/Native.cs").read_text()
        self.compare(functions(text, r"static extern (?P<result>\w+) (?P<name>pacini_\w+)\((?P<arguments>[^)]*)\);"))

    def test_rust(self):
        text = re.sub(r"\w+: ", "", (BINDINGS / "rust/src/sys.rs").read_text())
        self.compare(functions(text, r"pub fn (?P<name>\w+)\((?P<arguments>[^)]*)\)(?: -> (?P<result>[^;]+))?;"))

    def test_node(self):
        text = (BINDINGS / "node/index.js").read_text()
        self.compare(functions(text, r"'(?P<result>[\w *]+?) ?\b(?P<name>pacini_\w+)\((?P<arguments>[^)]*)\)'"))

    def test_a_wrong_type_is_found(self):
        self.assertEqual(of_header()["pacini_play_set"], ["i32", "play", "i32", "f64", "f64", "i64"])
        self.assertEqual(of_header()["pacini_clip_load"], ["i32", "pointer", "size", "pointer to clip"])
        self.assertEqual(of_header()["pacini_result_text"], ["pointer", "i32"])
        with self.assertRaises(AssertionError):
            self.compare({"pacini_api_version": ["i32"]}, 1)
        with self.assertRaises(AssertionError):
            self.compare({"pacini_nothing": ["i32"]}, 1)


if __name__ == "__main__":
    unittest.main()
