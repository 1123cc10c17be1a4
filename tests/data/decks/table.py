"""The comparison that `make decks` wrote, a line a deck, as the table of docs/import_decks.md."""
import csv
import sys
from itertools import groupby


def main(file):
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    order = {program: i for i, program in enumerate(("Nastran", "Abaqus", "CalculiX", "ANSYS", "SAP2000"))}
    rows.sort(key=lambda row: (order[row["program"].split(",")[0]], row["deck"]))  # stable: modes stay in their order
    print("| program | deck | modes | known from | largest difference % | allowed % | remark |\n|---|---|---|---|---|---|---|")
    for (program, deck), modes in groupby(rows, key=lambda row: (row["program"], row["deck"])):
        modes = list(modes)
        worst = max((float(m["difference_pct"]) for m in modes if m["difference_pct"]), key=abs)
        told = f"{worst:+.2f}" if abs(worst) >= 0.005 else "below 0.005"
        print(f"| {program} | {deck} | {len(modes)} | {modes[0]['known_from']} | {told} | {float(modes[0]['allowed_pct']):g} | {modes[0]['remark']} |")


if __name__ == "__main__":
    main(sys.argv[1])
