"""Figures of experiments: SVG files that are the same for the same numbers, so that git shows only what changed."""

import io
from string import ascii_lowercase

from small_tables import write_whole


def pyplot_for_svg():
    """Matplotlib's pyplot without a screen. It takes a second to load, so scripts ask for it only where they draw."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    matplotlib.rcParams |= {"svg.hashsalt": "menger", "font.size": 9}
    return pyplot


def letter_panels(titled):
    """Gives panels, which come with their titles, letters from a on, and a grid behind what they show."""
    for letter, (panel, title) in zip(ascii_lowercase, titled):
        panel.set_title(f"{letter}  {title}", loc="left", fontsize=8.5, fontweight="bold")
        panel.grid(color="#dddddd")
        panel.set_axisbelow(True)


def settle(figure):
    """Fixes where panels are, to a tenth of a thousandth of the figure: a constrained layout differs in last digits from run to run."""
    figure.canvas.draw()
    figure.set_layout_engine("none")
    for panel in figure.axes:
        panel.set_position([round(number, 4) for number in panel.get_position().bounds])


def write_svg(figure, file):
    """Writes a figure, whole or not at all, without the date."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    write_whole(file, text.getvalue())
