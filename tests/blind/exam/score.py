"""The score of the exam: shares with exact 95 % intervals, as a table that stands in the documentation."""
import csv
import pathlib
import sys

from intervals import share


def lines(rows):
    """(what, value) of every line."""
    damaged = [r for r in rows if r["pattern"] not in ("0", "5")]
    fifth = [r for r in rows if r["pattern"] == "5"]
    sound = [r for r in rows if r["pattern"] == "0"]

    def rated(of, column, *which):
        asked = [r for r in of if r[column]]
        return share(sum(r[column] in which for r in asked), len(asked))

    for title, of in (("patterns 1 to 4 and 6", damaged), ("pattern 5", fifth)):
        for rating in ("complete", "half", "unknown", "none", "wrong"):
            yield f"{title}: {rating}", rated(of, "rating", rating)
    for rating, words in (("none", "`none`"), ("unknown", "`unknown`"), ("wrong", "a name or a set")):
        yield f"sound pairs: {words}", rated(sound, "rating", rating)
    for case in sorted({r["case"] for r in rows}):
        here = [r for r in rows if r["case"] == case]
        ours = max((float(r["largest_false_loss_pct"]) for r in here if r["largest_false_loss_pct"]), default=None)
        theirs = max((float(r["squares_false_loss_pct"]) for r in here if r["squares_false_loss_pct"]), default=0.0)
        told = "-" if ours is None else f"{ours:.1f} %"
        yield f"case {case}: worst false loss on a sound storey, diagnosis; least squares", f"{told}; {theirs:.1f} %"
    yield "least squares: largest losses are the true ones (patterns 1 to 4 and 6)", rated(damaged, "squares_located", "1")
    for rating in ("complete", "half", "unknown", "none", "wrong"):
        yield f"falsification: {rating} (patterns 1 to 4 and 6)", rated(damaged, "falsification", rating)
    yield "falsification: sound pairs `none`", rated(sound, "falsification", "none")


def write_score(table):
    """Prints the score of a table of exam.py and writes it beside it, as Markdown."""
    with open(table, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    versions = sorted({r["version"] for r in rows if r["version"]}) or ["step 9 was not run"]
    text = f"twindeck {', '.join(versions)}; {len(rows)} pairs\n\n| | rate, exact 95 % interval |\n|---|---|\n"
    text += "".join(f"| {what} | {value} |\n" for what, value in lines(rows))
    table.with_suffix(".md").write_text(text, encoding="utf-8")
    print("\n" + text)


if __name__ == "__main__":
    write_score(pathlib.Path(sys.argv[1]))
