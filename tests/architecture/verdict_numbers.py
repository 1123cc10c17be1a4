"""Numbers and rules that shape a verdict of step 9: `python3 tests/architecture/verdict_numbers.py` lists them.

A number counts if a source of the law gives it a name (`constexpr double kFarOff = 0.08`, each entry of a list by itself) and it is none of
PRECISION: units, rounding, iterations, and how much is looked at before the evidence decides nothing else. Unnamed fields of DiagnoseOptions with a
value count too. A rule is a place outside the table of verdicts (one_verdict.cpp) that sets a verdict.
"""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ("law_*.[hc]pp", "inference/*.[hc]pp", "size_of_a_cause.cpp", "form_base.cpp", "features/form_columns.cpp")
# Units, rounding, the end of iterations and deviations that stand for "free".
PRECISION = {"kUnitOfClasses", "kUnitOfKinks", "kPerCent", "kNoVariance", "kLargestColumn", "kOneFit", "kShows", "kKeptMagnitudes",
             "kRidge", "kLongestStep", "kIterations", "kHalvings", "kSettled", "kAtRest", "kFirstContrast", "kWideScale", "kAside"}
NAMED = re.compile(r"^\s*(?:inline |static )?const(?:expr)? (?:double|int|std::size_t|std::array<[^>]*>) (k.*?);", re.M | re.S)
ONE = re.compile(r"(k[A-Z]\w*)(?:\[\])? = ((?:\{[^;]*\})|[^,;{]+)")
OPTION = re.compile(r"^\s*double (\w+) = (-?[\d.]+);", re.M)
RULE = re.compile(r"^.*(?:out_?\.)?verdict = .*(?:Verdict::|without_a_cause).*$", re.M)


def numbers(folder=ROOT / "src/diagnosis"):
    """(file, name) of each number that shapes a verdict; a list of n numbers is n times there."""
    found = []
    for pattern in SOURCES:
        for file in sorted(folder.glob(pattern)):
            for names in NAMED.findall(file.read_text(encoding="utf-8")):
                for name, value in ONE.findall(names):
                    count = len(re.findall(r"\d[\d.e-]*", value)) if value.startswith("{") else 1
                    found += [(str(file.relative_to(folder)), name)] * count if name not in PRECISION else []
    options = (folder / "diagnose.hpp").read_text(encoding="utf-8")
    options = options[options.index("struct DiagnoseOptions"):]
    return found + [("diagnose.hpp", name) for name, _ in OPTION.findall(options[:options.index("};")])]


def rules(folder=ROOT / "src/diagnosis"):
    """(file, line) of each place outside the table that sets a verdict."""
    return [(file.name, line.strip()) for file in sorted(folder.glob("law_*.cpp")) for line in RULE.findall(file.read_text(encoding="utf-8"))]


if __name__ == "__main__":
    for title, found in (("numbers", numbers()), ("rules", rules())):
        print(f"{len(found)} {title}")
        for where, what in found:
            print(f"  {where}: {what}")
