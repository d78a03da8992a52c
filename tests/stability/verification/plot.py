"""Draws the plot of a family by gnuplot, as the program draws its own."""
import os
import subprocess

from verification.case import Number

SIZE = "720,400"


def quoted(text):
    return "'" + text.replace("'", "''").replace("_", r"\_") + "'"


def draw(file, plot, outcomes):
    """The curves of theory and each series of cases: as points beside curves, else joined by lines."""
    series = {}
    for outcome in outcomes:
        missing = outcome.value is None and isinstance(outcome.case.expected, Number)
        if outcome.case.series and not missing:
            series.setdefault(outcome.case.series, []).append((outcome.case.at, plot.height(outcome)))
    style = "points pointtype 7 pointsize 0.7" if plot.curves else "linespoints pointtype 7 pointsize 0.5"
    curves = [(title, points, "lines dashtype 2 linecolor 'gray40'") for title, points in plot.curves.items()]
    curves += [(title, sorted(points), style) for title, points in series.items()]
    data = "".join(f"$data{n} << end\n" + "".join(f"{x!r} {y!r}\n" for x, y in points) + "end\n"
                   for n, (_, points, _) in enumerate(curves))
    drawn = ", ".join(f"$data{n} with {style} title {quoted(title)}" for n, (title, _, style) in enumerate(curves))
    log = f"set logscale {plot.log}\n" + "".join(f"set format {axis} '10^{{%L}}'\n" for axis in plot.log)
    script = f"""set terminal svg size {SIZE} font 'Helvetica,13' background 'white'
set encoding utf8
set tics out
set key outside right
set xlabel {quoted(plot.x)}
set ylabel {quoted(plot.y)}
{log if plot.log else ""}{data}plot {drawn}
"""
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("GNUPLOT", "GNUTERM"))}
    done = subprocess.run(["gnuplot", "--default-settings"], input=script, capture_output=True, text=True, check=False,
                          env=kept)
    if done.returncode or "</svg>" not in done.stdout:
        raise RuntimeError(f"{file}: gnuplot failed: {done.stderr}")
    file.parent.mkdir(exist_ok=True)
    file.write_text(done.stdout, encoding="utf-8")
