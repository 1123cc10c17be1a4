"""The steps as boxes and arrows, as SVG: what reads what, how each ended and how long it took."""
import html

WIDTH, HEIGHT, GAP_X, GAP_Y = 162, 74, 26, 18
COLOURS = {"converged": "ok", "not run": "idle"}


def duration(seconds) -> str:
    if seconds is None:
        return ""
    return f"{seconds:.1f} s" if seconds < 100 else f"{int(seconds // 60)} min {int(seconds % 60):02d} s"


def flowchart(steps: list) -> str:
    """`steps` as figures.flow.flow gives them."""
    column, rows = {}, {}
    for step in steps:  # a step stands one column right of the last one that it reads
        column[step.token] = 1 + max((column[r] for r in step.reads if r in column), default=-1)
        rows.setdefault(column[step.token], []).append(step)
    tallest = max((len(r) for r in rows.values()), default=1)
    place = {}
    for x, members in rows.items():
        for y, step in enumerate(members):
            place[step.token] = (x * (WIDTH + GAP_X) + 2, (y + 0.5 * (tallest - len(members))) * (HEIGHT + GAP_Y) + 2)
    width, height = len(rows) * (WIDTH + GAP_X) - GAP_X + 4, tallest * (HEIGHT + GAP_Y) - GAP_Y + 4
    arrows = "".join(_arrow(place[r], place[s.token]) for s in steps for r in s.reads if r in place)
    boxes = "".join(_box(s, *place[s.token]) for s in steps)
    return (
        f'<svg class="flow" viewBox="0 0 {width:.0f} {height:.0f}" style="max-width:{width:.0f}px;--wide:{width:.0f}px" role="img" aria-label="Flowchart of the steps">'
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        f'<path d="M0 0L8 4L0 8z"/></marker></defs>{arrows}{boxes}</svg>'
    )


def _arrow(start, end) -> str:
    x0, y0, x1, y1 = start[0] + WIDTH, start[1] + HEIGHT / 2, end[0], end[1] + HEIGHT / 2
    bend = max(12.0, 0.5 * (x1 - x0))
    if x1 - x0 > WIDTH and abs(y1 - y0) < 1:  # passes a column: around its boxes
        return f'<path class="arrow" d="M{x0:.0f} {y0:.0f}C{x0 + 40:.0f} {y0 + 60:.0f} {x1 - 40:.0f} {y1 + 60:.0f} {x1:.0f} {y1:.0f}" marker-end="url(#tip)"/>'
    return f'<path class="arrow" d="M{x0:.0f} {y0:.0f}C{x0 + bend:.0f} {y0:.0f} {x1 - bend:.0f} {y1:.0f} {x1:.0f} {y1:.0f}" marker-end="url(#tip)"/>'


def _box(step, x: float, y: float) -> str:
    number, _, name = step.token.partition("_")
    lines = step.meaning.split("\n")[:2]
    words = "".join(
        f'<text class="words" x="{x + 12:.0f}" y="{y + 35 + 13 * i:.0f}">{html.escape(line)}</text>'
        for i, line in enumerate(lines)
    )
    state = COLOURS.get(step.status, "bad")
    if state == "ok" and step.message:  # it converged, and something beside it is to be read
        state = "warn"
    foot = html.escape(duration(step.seconds) if step.status == "converged" else step.status)
    title = html.escape(f"{step.token}: {step.status}{'. ' + step.message if step.message else ''}")
    return (
        f'<g class="box {state}"><title>{title}</title><rect x="{x:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="6"/>'
        f'<rect class="edge" x="{x:.0f}" y="{y:.0f}" width="4" height="{HEIGHT}" rx="2"/>'
        f'<text class="name" x="{x + 12:.0f}" y="{y + 18:.0f}">{html.escape(number)} <tspan>{html.escape(name)}</tspan></text>{words}'
        f'<text class="foot" x="{x + WIDTH - 10:.0f}" y="{y + HEIGHT - 8:.0f}">{foot}</text></g>'
    )
