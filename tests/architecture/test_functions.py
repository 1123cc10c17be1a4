"""A function longer than 60 lines has an entry in exceptions.toml that says why.

The lines of a function are counted from the first line of its signature to its closing brace, comments inside it included; a lambda
inside a function counts with it. The counter needs no compiler: it blanks comments, strings and preprocessor lines, then matches
braces. It knows C++ as this repository writes it and clang-format leaves it.

Oracle: planted functions of 60 and of 61 lines, of each kind that the sources hold.
"""
import pathlib
import re
import sys
import tempfile
import tomllib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from source_text import blanked  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAX_FUNCTION_LINES = 60

SCOPE = re.compile(r"^\s*(?:inline\s+)?namespace\b|^\s*extern\s*$|(?:^|[\s>;])(?:class|struct|union|enum)\s[^()]*$", re.S)
LAMBDA = re.compile(r"\[[^\[\]]*\]\s*(?:\((?:[^()]|\([^()]*\))*\))?\s*(?:mutable|noexcept|->\s*[\w:<>,\s*&]+|\s)*$")
MEMBER_IN_BRACES = re.compile(r"\)\s*(?:noexcept\s*)?:(?:[^:].*)?[\w>]\s*$", re.S)  # of a constructor: `A() : member_{…}`
INITIALISED = re.compile(r"=[^=()]*$")


def closing(text, opening):
    """Index of the brace that closes the one at `opening`."""
    depth = 0
    for brace in re.finditer(r"[{}]", text[opening:]):
        depth += 1 if brace.group() == "{" else -1
        if depth == 0:
            return opening + brace.start()
    raise ValueError("a brace is not closed")


def name_of(head):
    """What a function is called: `Class::name`, `operator+`, or `Suite.Test` of a test."""
    head = re.sub(r"\[\[.*?\]\]", "", head)  # attributes
    if test := re.match(r"\s*TEST(?:_F|_P)?\s*\(\s*(\w+)\s*,\s*(\w+)", head):
        return ".".join(test.groups())
    if operator := re.search(r"(?:\w+::)*operator\s*(?:\(\)|[^\s\w(]+|\w+)", head):
        return operator.group()
    depth = 0  # of template brackets; the first parenthesis outside of them opens the parameters
    for i, letter in enumerate(head):
        depth += {"<": 1, ">": -1}.get(letter, 0)
        if letter == "(" and depth <= 0:
            found = re.search(r"(~?\w+(?:<[^<>()]*>)?(?:::~?\w+)*)\s*$", head[:i])
            return found.group(1) if found else "(unnamed)"
    return "(unnamed)"


def functions(text):
    """[(name, first line, number of lines)] of every function that the text of a C++ file defines."""
    text, found = blanked(text), []

    def add(start, end, name):
        start += len(text[start:]) - len(text[start:].lstrip())
        first = text.count("\n", 0, start) + 1
        found.append((name, first, text.count("\n", 0, end) + 2 - first))

    def definition(start, opening, parentheses, end):
        """What the brace at `opening` opens; `start`: where its statement starts. Returns where the next statement starts."""
        close, head = closing(text, opening), text[start:opening]
        if parentheses == 0 and SCOPE.search(head) and "=" not in head:
            statements(opening + 1, close)
            return close, close + 1
        if LAMBDA.search(head):
            name = re.search(r"(\w+)\s*=\s*\[", head)
            add(start, close, name.group(1) if name else "(lambda)")
        elif parentheses == 0 and "(" in head and not INITIALISED.search(head) and not MEMBER_IN_BRACES.search(head):
            while text[close + 1:end].lstrip().startswith("catch"):  # the handler of a function's try block belongs to it
                close = closing(text, text.index("{", close + 1))
            add(start, close, name_of(head))
            return close, close + 1
        elif parentheses > 0 or "=" in head:
            statements(opening + 1, close)  # a table at namespace scope may hold lambdas
        return close, start

    def statements(begin, end):
        """The statements between two braces of a namespace or of a class."""
        start, i, parentheses = begin, begin, 0
        while i < end:
            parentheses += {"(": 1, ")": -1}.get(text[i], 0)
            if parentheses == 0 and (text[i] == ";" or (text[i] == ":" and text[i + 1] != ":" and
                                                        re.search(r"\b(?:public|private|protected)\s*$", text[start:i]))):
                start = i + 1
            elif text[i] == "{":
                i, start = definition(start, i, parentheses, end)
            i += 1

    statements(0, len(text))
    return found


def long_functions(root):
    """{"file: name": lines} of the functions below src and tests that are too long."""
    return {f"{file.relative_to(root)}: {name}": lines for part in ("src", "tests") for file in sorted((root / part).rglob("*.[hc]pp"))
            for name, _, lines in functions(file.read_text()) if lines > MAX_FUNCTION_LINES}


class Functions(unittest.TestCase):
    def test_a_long_function_has_an_entry_that_says_why(self):
        entries = tomllib.loads((ROOT / "tests/architecture/exceptions.toml").read_text())["long_functions"]
        found = long_functions(ROOT)
        missing = {name: lines for name, lines in found.items() if not entries.get(name, "").strip()}
        self.assertEqual(missing, {}, f"over {MAX_FUNCTION_LINES} lines: cut by idea, or say why in exceptions.toml")
        self.assertEqual(sorted(set(entries) - set(found)), [], "no longer over the limit: remove the entry")


class TheCounterIsRight(unittest.TestCase):
    def of_length(self, signature, lines, indent=""):
        """A function of this many lines whose body would mislead a counter of braces."""
        misleading = ["// }", "/* } */ const char brace = '}';", 'const char* text = "}\\"}";', 'const auto raw = R"x(}})x";',
                      "const int thousand = 1'000; if (thousand) { }", "#define BRACE }"]
        body = (misleading + ["++i;"] * lines)[:lines - 1 - signature.count("\n") - 1]
        return "\n".join(indent + line for line in [signature + " {", *body, "}"])

    KINDS = {
        "int plain(int i)": "plain",
        "std::vector<std::function<int(int)>>\nlong_result(const std::map<int, int>& i = {}, int k = 2)": "long_result",
        "Room::Room(int i) : walls_{4}, i_{i}, doors_(2)": "Room::Room",
        "bool Room::operator==(const Room& other) const noexcept": "Room::operator==",
        "TEST_F(Suite, Name)": "Suite.Name",
        "template <class A, int n = 3>\n[[nodiscard]] auto templated(A i) -> decltype(i)": "templated",
        '[[gnu::target_clones("default", "avx2")]] void attributed(double* i)': "attributed",
        'extern "C" int entry(const char* i)': "entry",
        "const auto lambda = [](int i)": "lambda",
    }

    def test_sixty_lines_are_counted_as_sixty_and_sixty_one_as_sixty_one(self):
        for signature, name in self.KINDS.items():
            for lines in (60, 61):
                text = ('#include "a.hpp"\n/// A {comment} before.\nnamespace a {\nstruct B { int c; };\nconstexpr int table[] = {1, 2};\n'
                        + self.of_length(signature, lines) + (";" if name == "lambda" else "") + "\nint after() { return 1; }\n}  // namespace a\n")
                self.assertEqual([(n, count) for n, _, count in functions(text)], [(name, lines), ("after", 1)], signature)

    def test_functions_in_a_class_are_counted_one_by_one(self):
        text = "class A : public ::b::C {\n public:\n" + self.of_length("  void d()", 61) + "\n\n private:\n  void e() {\n  }\n  int f_{1};\n};\n"
        self.assertEqual([(n, count) for n, _, count in functions(text)], [("d", 61), ("e", 2)])

    def test_a_lambda_in_a_table_is_counted(self):
        text = "const Row rows[] = {\n{1, " + self.of_length("[](int i)", 61) + "}, {2, {}}};\n"
        self.assertEqual([count for _, _, count in functions(text)], [61])

    def test_the_handler_of_a_function_counts_with_it(self):
        text = "void f() try {\n" + "++i;\n" * 57 + "} catch (...) {\n}\nvoid g() {\n}\n"
        self.assertEqual([(n, count) for n, _, count in functions(text)], [("f", 60), ("g", 2)])

    def test_a_planted_function_of_61_lines_is_found(self):
        root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for part, lines in (("src", 61), ("tests", 60)):
            (root / part).mkdir()
            (root / part / "a.cpp").write_text(self.of_length("void planted(int i)", lines) + "\n")
        self.assertEqual(long_functions(root), {"src/a.cpp: planted": 61})


if __name__ == "__main__":
    unittest.main()
