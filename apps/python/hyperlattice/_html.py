"""Plans and runs as HTML, for notebooks."""
from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any, Iterable

if TYPE_CHECKING:
    from ._plan import Plan
    from ._result import Result

# Rows of tables: key of the JSON, name, unit, and factor from the key's unit.
_BODY = (
    ("particles", "particles", "", 1),
    ("springs", "springs", "", 1),
    ("degrees_of_freedom", "degrees of freedom of a particle", "", 1),
    ("precision", "precision", "", 1),
    ("threads", "threads", "", 1),
    ("steps", "steps", "", 1),
    ("time_step", "time step", "s", 1),
    ("critical_time_step", "critical time step", "s", 1),
    ("end_time", "end time", "s", 1),
)
_NEEDS = (
    ("memory_bytes", "memory", "MB", 1e-6),
    ("output_bytes", "output", "MB", 1e-6),
    ("expected_seconds", "expected run time", "s", 1),
)
_SECONDS = (
    ("solve", "time of the steps", "s", 1),
    ("output", "time of the output", "s", 1),
)
_ENERGY = (
    ("kinetic", "kinetic energy", "J", 1),
    ("stored", "stored energy", "J", 1),
    ("dissipated", "dissipated energy", "J", 1),
    ("injected", "work of the loads", "J", 1),
    ("relative_error", "relative error of the energy balance", "", 1),
)
_NARROW_SPACE = "\u202f"


def _number(value: Any) -> str:
    if isinstance(value, bool) or value is None:
        return str(value)
    if isinstance(value, int):
        return f"{value:,}".replace(",", _NARROW_SPACE)
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _table(rows: Iterable[tuple[str, str]]) -> str:
    left = 'style="text-align:left"'
    cells = "".join(f"<tr><th {left}>{escape(name)}</th><td {left}>{escape(value)}</td></tr>" for name, value in rows)
    return f"<table>{cells}</table>"


def _rows(values: dict[str, Any], shown: Iterable[tuple[str, str, str, float]]) -> Iterable[tuple[str, str]]:
    """Rows of the keys that have a value."""
    for key, name, unit, factor in shown:
        if values.get(key) is not None:
            value = values[key] if factor == 1 else values[key] * factor
            yield name, f"{_number(value)} {unit}".strip()


def _title(values: dict[str, Any]) -> str:
    return f": {escape(str(values['title']))}" if values.get("title") else ""


def _warnings(warnings: list[str]) -> str:
    return "".join(f"<p><b>Warning:</b> {escape(text)}</p>" for text in warnings)


def _functions(plan: Plan) -> str:
    return "".join(f"<p><b>Slow:</b> {escape(one['type'])} calls {escape(one['function'])} {escape(one['called'])}</p>"
                   for one in plan.get("python_functions", []))


def plan_page(plan: Plan) -> str:
    table = _table([*_rows(plan, _BODY), *_rows(plan, _NEEDS)])
    left_out = _table((one["what"], one["why"]) for one in plan.get("left_out", []))
    return (f"<h4>Plan{_title(plan)}</h4>{table}{_warnings(plan.get('warnings', []))}{_functions(plan)}"
            f"<details><summary>Left out, and why</summary>{left_out}</details>")


def result_page(result: Result) -> str:
    summary = result.summary
    reason = f": {summary['reason']}" if summary.get("reason") else ""
    rows = [("status", summary["status"] + reason), *_rows(summary, _BODY)]
    rows += _rows(summary.get("wall_seconds", {}), _SECONDS)
    rows += _rows(summary.get("energy", {}), _ENERGY)
    broken = summary.get("broken_springs", {})
    if broken.get("open") or broken.get("closed"):
        rows.append(("broken springs", f"{_number(broken['open'])} open, {_number(broken['closed'])} closed"))
    rows += [("tables", ", ".join(result.tables)), ("state hash", summary["state_hash"])]
    rows.append(("folder", str(result.folder)))
    return f"<h4>Run{_title(summary)}</h4>{_table(rows)}{_warnings(summary.get('warnings', []))}"
