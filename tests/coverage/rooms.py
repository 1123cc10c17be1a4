"""gcovr's summary by room of src, as a table in Markdown: rooms.py coverage.json"""
import json
import sys

# Rooms that compute and read no files, where a line that no test reaches is a number that nothing holds.
NUMERICS = ("linalg", "signal", "modal", "wind", "fe", "dynamics", "matching", "sensitivity", "transient", "identification", "aero", "buffeting", "updating", "sensors",
            "diagnosis")
BESIDE = ("aero/files", "diagnosis/files", "diagnosis/words")  # rooms inside one of these that read files and make sentences
LEAST_LINES_PCT = 95.0  # asked of the rooms of numerics


def room(name: str) -> str:
    """src/fe/beam.cpp -> fe; src/steps/updating/run.cpp -> steps; src/diagnosis/words/sentences.cpp -> diagnosis/words"""
    folders = name.split("/")[1:-1]
    return "/".join(folders) if "/".join(folders) in BESIDE else folders[0]


def by_room(summary: dict) -> dict:
    """{room: [lines, lines covered, branches, branches covered]}"""
    found = {}
    for file in summary["files"]:
        counts = found.setdefault(room(file["filename"]), [0, 0, 0, 0])
        for i, key in enumerate(("line_total", "line_covered", "branch_total", "branch_covered")):
            counts[i] += file[key]
    return found


def percent(covered: int, total: int) -> float:
    return 100.0 * covered / total if total else 100.0


def table(rooms: dict) -> str:
    rows = ["| room | lines | covered | branches | covered | |", "|---|--:|--:|--:|--:|---|"]
    total = [sum(column) for column in zip(*rooms.values())] if rooms else [0, 0, 0, 0]
    for name, (lines, lines_covered, branches, branches_covered) in [*sorted(rooms.items()), ("all", total)]:
        low = name in NUMERICS and percent(lines_covered, lines) < LEAST_LINES_PCT
        rows.append(f"| {name} | {lines} | {percent(lines_covered, lines):.1f} % | {branches} | {percent(branches_covered, branches):.1f} % | "
                    f"{f'below {LEAST_LINES_PCT:.0f} %' if low else ''} |")
    return "\n".join(rows)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as stream:
        print("## Coverage by unit tests, laws, verification and the smoke chain\n\n" + table(by_room(json.load(stream))))
