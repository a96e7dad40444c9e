"""Where a C++ source can be changed by one small step, and the text that makes the change switchable (Mutants.h)."""
import re
import zlib
from dataclasses import dataclass

TOKEN = re.compile(r"""
    (?P<skip>//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:[^\n\\]|\\\n|\\.)*|R"(\w*)\(.*?\)\2"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+')
  | (?P<number>\b\d[\d']*(?:\.[\d']*)?(?:[eE][+-]?\d+)?[a-zA-Z_]*|\.\d+(?:[eE][+-]?\d+)?[a-zA-Z]*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<operator>->|::|\+\+|--|<<=?|<=>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
""", re.X | re.S | re.M)
# Lines whose text the compiler needs as it is, and those that change nothing but time or what a wrong program does.
FIXED = re.compile(r"\b(template|static_assert|using|typedef|requires|concept|operator|case|enum|noexcept\(|alignas|extern)\b"
                   r"|^\s*assert\(|\.reserve\(|constexpr.*\(.*\)\s*(const)?\s*(noexcept)?\s*[{;]?\s*$|if constexpr")
BINARY = {"+": ("plus", "-"), "-": ("minus", "+"), "*": ("times", "/"), "/": ("over", "*"), "<": ("less", "<="),
          "<=": ("lessOrEqual", "<"), ">": ("greater", ">="), ">=": ("greaterOrEqual", ">"), "==": ("equal", "!="),
          "!=": ("unequal", "==")}
STATEMENT = re.compile(r"[ ]+((?!return\b|break\b|continue\b|throw\b|using\b|delete\b|else\b|goto\b|if\b|for\b|while\b|do\b)"
                       r"[A-Za-z_][\w.:\[\]]*(?:->[\w.\[\]]+|\([^;]*\)|\[[^;]*\])*(?: [-+*/|&]?= [^;]+|\([^;]*\)));$")
# A constant: known while running only, so that it can change. A function has a bracket before any = or {.
CONSTANT = re.compile(r"^[ \t]*((?:(?:static|inline) )*)constexpr (?=[^(){;=]*[={])", re.M)
OPENING, CLOSING = {"(": ")", "[": "]", "{": "}"}, {")", "]", "}"}


@dataclass
class Change:
    path: str
    line: int
    text: str  # of the line, without the space around it
    what: str  # "`<` -> `<=`"
    edits: list  # of the file: (start, end, text in which N stands for the number of the change)
    dropped: bool = False

    def __str__(self):
        return f"{self.path}:{self.line}  {self.what}   {self.text}"


@dataclass
class Token:
    kind: str
    text: str
    start: int
    end: int


def tokens_of(text):
    return [Token(match.lastgroup, match.group(), match.start(), match.end()) for match in TOKEN.finditer(text)
            if match.lastgroup != "skip" and not match.group().isspace()]


def partners(tokens):
    """Index of each bracket -> index of the one that closes or opens it."""
    open_, pairs = [], {}
    for i, token in enumerate(tokens):
        if token.text in OPENING:
            open_.append(i)
        elif token.text in CLOSING and open_:
            pairs[i] = open_.pop()
            pairs[pairs[i]] = i
    return pairs


@dataclass
class Constant:
    start: int
    end: int
    head: str  # "static constexpr "
    in_function: bool


def constants_of(text, tokens, pairs):
    """The definitions of constants, of one line or many."""
    found = []
    for match in CONSTANT.finditer(text):
        i = next(i for i, token in enumerate(tokens) if token.start >= match.end())
        while tokens[i].text != ";":
            i = pairs.get(i, i) + 1 if tokens[i].text in OPENING else i + 1
        start = match.start(1)
        found.append(Constant(start, tokens[i].start, text[start:match.end()], in_function(start, tokens, pairs)))
    return found


def in_function(position, tokens, pairs):
    """Whether a place is in the body of a function, and not of a class or namespace."""
    around = [begin for begin, end in pairs.items() if tokens[begin].text == "{" and begin > 0
              and tokens[begin].start < position < tokens[end].start]
    return bool(around) and tokens[max(around) - 1].text in (")", "const", "noexcept", "override")


def other_number(text, choice):
    """Another number of the same type, not far away."""
    if re.fullmatch(r"\d[\d']*[uUlLzZ]*", text):
        digits = re.match(r"[\d']+", text).group()
        value = int(digits.replace("'", ""))
        return f"{value - 1 if value > 0 and choice % 2 else value + 1}{text[len(digits):]}"
    if match := re.fullmatch(r"([\d'.]+(?:[eE][+-]?\d+)?)([fFlL]?)", text):
        value = float(match.group(1).replace("'", ""))
        changed = 1.0 if value == 0.0 else value * (2.0 if choice % 2 else 0.5)
        return f"{changed!r}{match.group(2)}"
    return None


def changes_of(path, text):
    tokens, found = tokens_of(text), []
    pairs = partners(tokens)
    constants = constants_of(text, tokens, pairs)
    starts = [0] + [match.end() for match in re.finditer("\n", text)]
    lines = text.split("\n")

    def line_of(position):
        low, high = 0, len(starts)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if starts[middle] <= position else (low, middle)
        return low

    def add(position, what, *edits):
        line = line_of(position)
        extra = []
        if constant := next((one for one in constants if one.start <= position < one.end), None):
            if any(edit[0] < constant.start + len(constant.head) for edit in edits):
                return
            inline = "inline " if "inline" in constant.head else "static inline " if "static" in constant.head else ""
            if constant.in_function:
                inline = inline.replace("inline ", "")
            extra = [(constant.start, constant.start + len(constant.head), f"{inline}const ")]
            # Else the compiler would work it out all the same, as it does for every constant that it can.
            edits = [(start, end, new.replace("<N", "<mutants::most + N")) for start, end, new in edits]
        elif FIXED.search(lines[line]):
            return
        found.append(Change(path, line + 1, lines[line].strip(), what, [*extra, *edits]))

    for i, token in enumerate(tokens):
        before = tokens[i - 1] if i > 0 else token
        after = tokens[i + 1] if i + 1 < len(tokens) else token
        spaced = text[token.start - 1:token.start] == " " and text[token.end:token.end + 1] in (" ", "\n")
        choice = zlib.crc32(f"{path}{i}".encode())
        if token.kind == "number":
            inside = before.text in ("<", ",") and after.text in (">",) or after.text == ":"
            if not inside and (changed := other_number(token.text, choice)):
                add(token.start, f"`{token.text}` -> `{changed}`",
                    (token.start, token.end, f"mutants::either<N>({token.text}, {changed})"))
        elif token.text in ("true", "false"):
            other = "false" if token.text == "true" else "true"
            add(token.start, f"`{token.text}` -> `{other}`",
                (token.start, token.end, f"mutants::either<N>({token.text}, {other})"))
        elif token.text in BINARY and spaced and (before.kind in ("word", "number") or before.text in (")", "]", "}")) \
                and before.text not in ("return", "case", "operator"):
            name, other = BINARY[token.text]
            add(token.start, f"`{token.text}` -> `{other}`",
                (token.start, token.end, f"{token.text} mutants::{name}<N> {token.text}"))
        elif token.text in ("&&", "||") and spaced:
            depth, end = 0, i + 1
            while end < len(tokens) and (depth > 0 or tokens[end].text not in ("&&", "||", ")", "]", "}", ";", "?", ":", ",")):
                depth += (tokens[end].text in OPENING) - (tokens[end].text in CLOSING)
                end += 1
            kept = "mutants::on<N>() || " if token.text == "&&" else "!mutants::on<N>() && "
            add(token.start, f"nothing after `{token.text}`", (after.start, after.start, f"({kept}("),
                (tokens[end - 1].end, tokens[end - 1].end, "))"))
        elif token.text in ("min", "max") and before.text == "::" and tokens[i - 2].text == "std" and after.text == "(":
            least = "true" if token.text == "min" else "false"
            add(token.start, f"std::{token.text} -> std::{'max' if least == 'true' else 'min'}",
                (tokens[i - 2].start, token.end, f"mutants::extreme<N, {least}>"))
        elif token.text == "clamp" and before.text == "::" and tokens[i - 2].text == "std" and after.text == "(":
            add(token.start, "no std::clamp", (tokens[i - 2].start, token.end, "mutants::clamp<N>"))
        elif token.text == "if" and after.text == "(" and i + 1 in pairs:
            inside = tokens[i + 2:pairs[i + 1]]
            if not any(t.text in (";", "=", "auto") for t in inside):
                to = "true" if choice % 2 else "false"
                add(token.start, f"if ({to})", (after.end, after.end, f"mutants::forced<N, {to}>("),
                    (tokens[pairs[i + 1]].start, tokens[pairs[i + 1]].start, ")"))
    for number, line in enumerate(lines):
        statement = STATEMENT.match(line)
        previous = lines[number - 1].split("//")[0].rstrip() if number else ""
        if statement and not FIXED.search(line) and line.count("(") == line.count(")") and previous.endswith((";", "{", "}", ")", "else")):
            start = starts[number] + statement.start(1)
            found.append(Change(path, number + 1, line.strip(), "without this statement",
                                [(start, start, "{ if (!mutants::on<N>()) "),
                                 (starts[number] + len(line), starts[number] + len(line), " }")]))
    return found


def in_place(text, changes):
    """The text with all these (number, change) in it. Lines stay where they are."""
    edits = []
    for number, change in changes:
        for start, end, new in change.edits:
            edit = (start, end, re.sub(r"\bN\b", str(number), new))
            if start == end or edit not in edits:  # changes of one constant share that it is one no more
                edits.append(edit)
    # At one place a statement opens before its parts.
    edits.sort(key=lambda edit: (edit[0], edit[1], not edit[2].startswith("{")))
    result, position = [], 0
    for start, end, new in edits:
        if start < position:
            raise ValueError(f"two changes overlap: {new}")
        result += [text[position:start], new]
        position = end
    return "".join(result) + text[position:]


def blamed(chosen, output):
    """The changes that GCC's messages are about: by their line, or by their number where a statement has several lines."""
    places = {(path, int(line)) for path, line in re.findall(
        r"(?:^|[ (])(?:\S*/)?source/((?:Core|Source)/\S+?):(\d+)(?=[:,])", output, re.M)}
    numbers = {int(number) for number in re.findall(r"mutants::[^\n]*\bint N = (\d+)", output)}
    return [change for number, change in enumerate(chosen)
            if not change.dropped and (number in numbers or (change.path, change.line) in places)]
