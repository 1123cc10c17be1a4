"""Style and scripts of the page, and three.js if it is there: everything is put into the page when it is made."""
import json
import os
from pathlib import Path

ASSETS = Path(__file__).parent / "assets"
SCRIPTS = ("orbit.js", "flat.js", "solid.js", "viewer.js", "modes.js", "where.js", "choices.js", "poles.js", "page.js")
THREE = ("/usr/share/javascript/three/three.min.js", "/usr/share/javascript/three/build/three.min.js")


def style() -> str:
    return (ASSETS / "page.css").read_text(encoding="utf-8")


def scripts() -> str:
    """One function scope, so that nothing but window.twindeck is left in the page's names."""
    body = "\n".join((ASSETS / name).read_text(encoding="utf-8") for name in SCRIPTS)
    return f'"use strict";\n(() => {{\n{body}\n}})();'


def three() -> str:
    """Debian's libjs-three (MIT licence); without it the page draws with its own plain projection."""
    for name in (os.environ.get("TWINDECK_THREE", ""), *THREE):
        if name and Path(name).is_file():
            text = Path(name).read_text(encoding="utf-8")
            return "" if "</script" in text.lower() else text
    return ""


def embedded(data) -> str:
    """JSON that is safe between script tags."""
    return json.dumps(data, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
