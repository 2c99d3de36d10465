from types import SimpleNamespace

from roslens.live.agent.gpu import gpu_reader


class Nvml:
    """A driver with two GPUs, of which the second tells no load."""

    NVML_TEMPERATURE_GPU = 0

    def nvmlInit(self):  # noqa: N802
        pass

    def nvmlDeviceGetCount(self):  # noqa: N802
        return 2

    def nvmlDeviceGetHandleByIndex(self, number):  # noqa: N802
        return number

    def nvmlDeviceGetUtilizationRates(self, gpu):  # noqa: N802
        if gpu:
            raise RuntimeError("Not Supported")
        return SimpleNamespace(gpu=40)

    def nvmlDeviceGetMemoryInfo(self, gpu):  # noqa: N802
        return SimpleNamespace(used=[1, 3][gpu], total=4)

    def nvmlDeviceGetTemperature(self, gpu, sensor):  # noqa: N802
        return [50, 45][gpu]


def test_the_greatest_of_each():
    assert gpu_reader(lambda _: Nvml())() == {"gpu": 40.0, "gpu_memory_share": 75.0, "gpu_temperature": 50.0}


def test_without_a_package_or_a_driver_there_is_nothing_to_read():
    def missing(name):
        raise ModuleNotFoundError(name)

    assert gpu_reader(missing) is None
    broken = Nvml()
    broken.nvmlInit = lambda: 1 / 0
    assert gpu_reader(lambda _: broken) is None
