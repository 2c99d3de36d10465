"""NVIDIA GPUs through NVML, where its Python package (``nvidia-ml-py``) and a driver are there."""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Callable, Mapping
from typing import Any


def gpu_reader(load: Callable[[str], Any] = importlib.import_module) -> Callable[[], Mapping[str, float]] | None:
    """Return what reads the GPUs, None where there are none or nothing can be asked."""
    try:
        nvml = load("pynvml")
        nvml.nvmlInit()
        gpus = [nvml.nvmlDeviceGetHandleByIndex(number) for number in range(nvml.nvmlDeviceGetCount())]
    except Exception:  # noqa: BLE001 - a driver may fail in any way; without it there is nothing to read
        return None
    return (lambda: _read(nvml, gpus)) if gpus else None


def _read(nvml: Any, gpus: list[Any]) -> dict[str, float]:
    """Return the greatest of each value; values that a GPU does not report are left out."""
    found: dict[str, float] = {}
    questions: dict[str, Callable[[Any], float]] = {
        "gpu": lambda one: float(nvml.nvmlDeviceGetUtilizationRates(one).gpu),
        "gpu_memory_share": lambda one: _share(nvml.nvmlDeviceGetMemoryInfo(one)),
        "gpu_temperature": lambda one: float(nvml.nvmlDeviceGetTemperature(one, nvml.NVML_TEMPERATURE_GPU)),
    }
    for gpu in gpus:
        for key, ask in questions.items():
            # Not every GPU provides all values, and the exception depends on the driver.
            with contextlib.suppress(Exception):
                value = ask(gpu)
                found[key] = max(value, found.get(key, value))
    return found


def _share(memory: Any) -> float:
    return 100.0 * float(memory.used) / float(memory.total)
