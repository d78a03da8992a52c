"""Draws the plot of a family by gnuplot, as the program draws its own."""
import os
import subprocess

SIZE = "720,400"


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def draw(file, plot, outcomes):
    """A curve for each series of cases, in the order of its abscissas, and the curves of theory."""
    series = {}
    for outcome in outcomes:
        if outcome.case.series and outcome.value is not None:
            series.setdefault(outcome.case.series, []).append((outcome.case.at, plot.height(outcome)))
    curves = [(title, points, "lines dashtype 2 linecolor 'gray40'") for title, points in plot.curves.items()]
    curves += [(title, sorted(points), "linespoints pointtype 7 pointsize 0.5") for title, points in series.items()]
    data = "".join(f"$data{n} << end\n" + "".join(f"{x!r} {y!r}\n" for x, y in points) + "end\n"
                   for n, (_, points, _) in enumerate(curves))
    drawn = ", ".join(f"$data{n} with {style} title {quoted(title)}" for n, (title, _, style) in enumerate(curves))
    log = f"set logscale {plot.log}\n" + "".join(f"set format {axis} '10^{{%L}}'\n" for axis in plot.log) if plot.log else ""
    script = f"set terminal svg size {SIZE} font 'Helvetica,13' background 'white'\nset encoding utf8\nset tics out\n" \
             f"set key outside right\nset xlabel {quoted(plot.x)}\nset ylabel {quoted(plot.y)}\n{log}{data}plot {drawn}\n"
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("GNUPLOT", "GNUTERM"))}
    done = subprocess.run(["gnuplot", "--default-settings"], input=script, capture_output=True, text=True, check=False, env=kept)
    if done.returncode or "</svg>" not in done.stdout:
        raise RuntimeError(f"{file}: gnuplot failed: {done.stderr}")
    file.parent.mkdir(exist_ok=True)
    file.write_text(done.stdout, encoding="utf-8")
