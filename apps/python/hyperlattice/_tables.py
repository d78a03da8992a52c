"""Tables of a run (CSV) as a DataFrame of pandas, or without pandas as a dict of NumPy arrays."""
from __future__ import annotations

import csv
import pathlib
from typing import Any

import numpy as np


def _array(texts: list[str]) -> np.ndarray:
    """Whole numbers as int64, other numbers as float64, and texts as they are."""
    for number in (np.int64, np.float64):
        try:
            return np.array(texts, dtype=number) if texts else np.array([], dtype=np.float64)
        except (ValueError, OverflowError):
            continue
    return np.array(texts)


def read_columns(file: pathlib.Path) -> dict[str, np.ndarray]:
    with open(file, newline="", encoding="utf-8") as lines:
        rows = csv.reader(lines)
        names = next(rows, [])
        whole = [row for row in rows if len(row) == len(names)]  # a line that is being written is left out
    return {name: _array([row[n] for row in whole]) for n, name in enumerate(names)}


def read_table(file: pathlib.Path) -> Any:
    columns = read_columns(file)
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)
