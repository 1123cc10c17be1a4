"""Small charts as SVG that stay legible on a telephone: one width, set side by side where there is room."""
import html
import math

import numpy as np

WIDTH, HEIGHT = 360, 190  # of the view box: about the pixels of a telephone
LEFT, RIGHT, TOP, BOTTOM = 46, 8, 22, 32
MOST_POINTS = 240  # of a curve; of neighbours the largest is kept, so that no peak is lost
DECADES = 8  # below the largest value; what lies deeper is rounding


def thinned(frequency, values):
    """(f, v) with at most MOST_POINTS points."""
    step = max(1, math.ceil(len(frequency) / MOST_POINTS))
    blocks = [slice(i, i + step) for i in range(0, len(frequency), step)]
    at = [b.start + int(np.argmax(values[b])) for b in blocks]
    return frequency[at], values[at]


def log_range(curves) -> tuple:
    """Decades that hold all positive values of the curves."""
    values = np.concatenate([v[v > 0] for _, v, _ in curves] or [np.array([])])
    if not len(values):
        return 0, 1
    top = math.ceil(math.log10(values.max()))
    return max(math.floor(math.log10(values.min())), top - DECADES), top


def log_chart(curves: list, decades: tuple, marks: list, label: str) -> str:
    """`curves`: (frequency [Hz], positive values, class of the line); `marks`: (name, frequency [Hz]) of vertical lines."""
    low, high = float(min(f[0] for f, _, _ in curves)), float(max(f[-1] for f, _, _ in curves))
    floor, top = decades[0], max(decades[1], decades[0] + 1)

    def x(f):
        return LEFT + (WIDTH - LEFT - RIGHT) * (f - low) / ((high - low) or 1.0)

    def y(exponent):
        return HEIGHT - BOTTOM - (HEIGHT - BOTTOM - TOP) * (exponent - floor) / (top - floor)

    body = ""
    for t in ticks(low, high, 6):
        body += f'<path class="grid" d="M{x(t):.1f} {TOP}V{HEIGHT - BOTTOM}"/><text class="tick" x="{x(t):.1f}" y="{HEIGHT - BOTTOM + 14}" text-anchor="middle">{t:g}</text>'
    for t in range(floor, top + 1, max(1, math.ceil((top - floor) / 5))):
        body += f'<path class="grid" d="M{LEFT} {y(t):.1f}H{WIDTH - RIGHT}"/><text class="tick" x="{LEFT - 5}" y="{y(t) + 4:.1f}" text-anchor="end">10<tspan class="power" dy="-4">{t}</tspan></text>'
    last = -99.0
    for name, f in sorted(marks, key=lambda m: m[1]):
        if low <= f <= high:
            body += f'<path class="mode" d="M{x(f):.1f} {TOP}V{HEIGHT - BOTTOM}"/>'
            if x(f) - last > 13:  # names that would lie on each other are left out
                body += f'<text class="tick strong" x="{x(f):.1f}" y="{TOP - 5}" text-anchor="middle">{html.escape(str(name))}</text>'
                last = x(f)
    for f, values, kind in curves:
        clipped = np.log10(np.maximum(values, 10.0**floor))
        body += f'<path class="{kind}" d="M{"L".join(f"{x(a):.1f} {y(b):.1f}" for a, b in zip(f, clipped))}"/>'
    body += f'<path class="axes" d="M{LEFT} {TOP}V{HEIGHT - BOTTOM}H{WIDTH - RIGHT}"/>'
    body += f'<text class="tick" x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 3}" text-anchor="middle">frequency (Hz)</text>'
    return f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" role="img" aria-label="{html.escape(label)}">{body}</svg>'


def ticks(low: float, high: float, count: int) -> list:
    """About `count` round numbers between low and high."""
    raw = ((high - low) or 1.0) / count
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(m * power for m in (1, 2, 5, 10) if m * power >= raw * (1 - 1e-9))
    return [round(i * step, 12) for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]
