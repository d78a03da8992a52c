"""Waiting for work of the core: log messages, progress, and Ctrl-C."""
from __future__ import annotations

import logging
import sys
import time
from typing import Any, Callable

logger = logging.getLogger("hyperlattice")


def pass_on_log(work: Any, without: str = "") -> None:
    """Gives the core's messages to Python's logging, except errors that repeat the text of an exception."""
    for level, text in work.take_log():
        if not (without and level >= logging.ERROR and without in text):
            logger.log(level, "%s", text)


def wait_for(work: Any, show: Callable[[], None] | None = None) -> None:
    """Waits until the work has ended or waits itself. KeyboardInterrupt and the like pass through."""
    while not work.wait(0.1):
        pass_on_log(work)
        if show:
            show()


def wait_to_the_end(work: Any) -> None:
    """Waits for work that was asked to stop. A second Ctrl-C interrupts the waiting, not the work."""
    while not work.wait(0.1):
        pass


def clock_time(seconds: float) -> str:
    """1:02:03, 4:05, 0:12."""
    whole = round(seconds)
    hours, minutes, rest = whole // 3600, whole // 60 % 60, whole % 60
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


class Progress:
    """The progress line of a run, in a notebook or on a terminal. Short runs show nothing."""

    PATIENCE = 1.0  # s, before anything is shown
    PAUSE = 0.3  # s, between two lines

    def __init__(self, job: Any, shown: bool | None):
        self.job, self.start, self.last, self.handle, self.is_open = job, time.monotonic(), 0.0, None, False
        self.notebook = "ipykernel" in sys.modules
        self.wanted = shown if shown is not None else self.notebook or bool(sys.stderr and sys.stderr.isatty())

    def show(self) -> None:
        now = time.monotonic()
        if not self.wanted or now - self.start < self.PATIENCE or now - self.last < self.PAUSE:
            return
        self.last = now
        self._write(self._line(now - self.start))

    def _line(self, spent: float) -> str:
        step, reached, time_step, steps = self.job.reached()
        if not steps:
            return "planning the body"
        part = min(1.0, step / steps)
        left = clock_time(spent * (1 / part - 1)) if part > 0 else "?"
        return f"step {step}/{steps} ({100 * part:.1f}%)  t {reached:.4g} s  dt {time_step:.3g} s  ETA {left}"

    def _write(self, line: str) -> None:
        if self.notebook:
            from IPython.display import display
            text = {"text/plain": line}
            if self.handle is None:
                self.handle = display(text, raw=True, display_id=True)
            else:
                self.handle.update(text, raw=True)
            return
        terminal = sys.stderr.isatty()
        sys.stderr.write(f"\r{line}\x1b[K" if terminal else line + "\n")
        sys.stderr.flush()
        self.is_open = terminal

    def close(self) -> None:
        if self.is_open:
            sys.stderr.write("\n")
            self.is_open = False
