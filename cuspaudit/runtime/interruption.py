"""Ctrl-C while processes are begun: heard by one process, and not in the middle.

A terminal sends it to every process of a command. A child that is only starting would
answer with a traceback of its own, and one whose parent leaves it half started with
another.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from multiprocessing import active_children
from multiprocessing.process import BaseProcess
from types import FrameType

__all__ = ["deaf_children", "end_processes", "held"]


@contextmanager
def deaf_children() -> Iterator[None]:
    """Programs that are begun in this block never hear Ctrl-C."""
    if threading.current_thread() is not threading.main_thread():
        yield  # no other thread may say what a signal does
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def held() -> Iterator[None]:
    """An interruption in this block is heard at its end."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    met: list[tuple[int, FrameType | None]] = []
    before = signal.signal(signal.SIGINT, lambda *heard: met.append(heard))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if met and callable(before):
        before(*met[0])


def end_processes(others: Sequence[BaseProcess]) -> None:
    """Kill the children of this process that are none of ``others``."""
    for child in active_children():
        if child not in others:
            child.kill()
