"""Change of each parameter of a matrix model against 1, as a table: changes.py MODEL CSV"""
import pathlib
import sys
import tomllib

if __name__ == "__main__":
    model, table = map(pathlib.Path, sys.argv[1:3])
    parameters = tomllib.loads((model / "model.toml").read_text(encoding="utf-8"))["parameter"]
    table.write_text("parameter,change\n" + "".join(f"{p['name']},{p['initial'] - 1.0:.12g}\n" for p in parameters))
