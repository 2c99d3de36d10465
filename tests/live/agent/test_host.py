"""Hosts made of files: a folder for /proc and one for /sys."""

import os
from pathlib import Path

import pytest

from roslens.live.agent.host import HostSampler
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind

FILES = {
    "proc/stat": "cpu  100 0 100 800 0 0 0 0 0 0\ncpu0 50 0 50 400 0 0 0 0 0 0\ncpu1 50 0 50 400 0 0 0 0 0 0\nintr 1\n",
    "proc/meminfo": "MemTotal: 1000 kB\nMemFree: 100 kB\nMemAvailable: 250 kB\nSwapTotal: 200 kB\nSwapFree: 150 kB\n",
    "proc/diskstats": (
        "   8 0 sda 1 0 100 0 1 0 200 0 0 0 0\n   8 1 sda1 1 0 100 0 1 0 200 0 0 0 0\n"
        " 7 0 loop0 1 0 900 0 1 0 900 0 0 0 0\n"
    ),
    "proc/net/dev": (
        "Inter-|   Receive\n face |bytes\n    lo: 900 9 0 0 0 0 0 0 900 9 0 0 0 0 0 0\n"
        "  eth0: 1000 9 0 1 0 0 0 0 2000 9 0 2 0 0 0 0\n"
    ),
    "proc/mounts": (
        "/dev/sda1 / ext4 rw,relatime 0 0\nproc /proc proc rw 0 0\n/dev/sdb1 /media/my\\040disk vfat rw 0 0\n"
        "/dev/sdc1 /cd iso9660 ro 0 0\n/dev/sda1 /again ext4 rw 0 0\n/dev/sdd1 /locked ext4 ro 0 0\n"
    ),
    "proc/loadavg": "0.52 0.58 0.59 1/467 12345\n",
    "proc/pressure/cpu": "some avg10=1.25 avg60=0.00 avg300=0.00 total=1\n",
    "proc/pressure/memory": "some avg10=0.00 avg60=0.00 avg300=0.00 total=0\nfull avg10=0.00\n",
    "proc/pressure/io": "some avg10=7.50 avg60=0.00 avg300=0.00 total=1\n",
    "sys/block/sda/size": "1",
    "sys/class/thermal/thermal_zone0/temp": "45000\n",
    "sys/class/thermal/thermal_zone1/temp": "-274000\n",
    "sys/class/hwmon/hwmon0/temp1_input": "61500\n",
}


class Space:
    """File systems of 1,000 blocks of 4 kB, by where they are mounted: how many are free."""

    def __init__(self, free):
        self.free = free
        self.asked = []

    def __call__(self, place):
        self.asked.append(place)
        if place not in self.free:
            raise OSError
        return os.statvfs_result((4096, 4096, 1000, self.free[place], self.free[place], 0, 0, 0, 0, 255))


def write(root: Path, files) -> None:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.fixture
def sampler(tmp_path):
    write(tmp_path, FILES)
    space = Space({b"/": 500, b"/media/my disk": 100})
    made = HostSampler("base", proc=tmp_path / "proc", sys=tmp_path / "sys", space=space)
    yield made
    made.close()


def test_first_sample(sampler):
    sample = sampler.sample(10.0)
    assert str(sample.entity) == "host:base"
    assert sample.values == {
        "memory": 750 * 1024,
        "memory_share": 75.0,
        "swap_share": 25.0,
        "disk_free": 100 * 4096,
        "disk_share": 90.0,
        "pressure_cpu": 1.25,
        "pressure_memory": 0.0,
        "pressure_io": 7.5,
        "load": 0.52,
        "temperature": 61.5,
    }


def test_rates_from_the_second_sample_on(sampler, tmp_path):
    sampler.sample(10.0)
    write(
        tmp_path,
        {
            "proc/stat": "cpu  130 0 120 850 0 0 0 0\ncpu0 80 0 70 400 0 0 0 0\ncpu1 50 0 50 450 0 0 0 0\n",
            "proc/diskstats": "   8 0 sda 1 0 104 0 1 0 220 0 0 0 0\n",
            "proc/net/dev": "a\nb\n    lo: 0 0 0 0 0 0 0 0 0 0 0 0\n  eth0: 3000 9 0 5 0 0 0 0 2500 9 0 2 0 0 0 0\n",
        },
    )
    values = sampler.sample(12.0).values
    assert values["cpu"] == 50.0
    assert values["cpu_core_max"] == 100.0
    assert (values["disk_read"], values["disk_write"]) == (4 * 512 / 2, 20 * 512 / 2)
    assert (values["network_in"], values["network_out"], values["network_drops"]) == (1000.0, 250.0, 2.0)


def snmp(sent, again):
    return {"proc/net/snmp": f"Ip: A\nIp: 1\nTcp: RtoAlgorithm OutSegs RetransSegs InErrs\nTcp: 1 {sent} {again} 0\n"}


def test_segments_that_were_sent_again_are_counted_over_five_seconds(sampler, tmp_path):
    reported = []
    for second, counts in enumerate(
        [(1000, 10), (1100, 10), (1200, 16), (1300, 16), (1400, 16), (1500, 16), (1600, 16)]
    ):
        write(tmp_path, snmp(*counts))
        reported.append(sampler.sample(10.0 + second).values.get("resent"))
    assert reported == [None, 0.0, 3.0, 2.0, 1.5, 1.2, 1.2]
    write(tmp_path, snmp(5, 0))
    assert "resent" not in sampler.sample(20.0).values


def test_of_few_segments_nothing_is_told(sampler, tmp_path):
    write(tmp_path, snmp(0, 0))
    sampler.sample(10.0)
    write(tmp_path, snmp(19, 2))
    assert "resent" not in sampler.sample(11.0).values


def test_a_counter_that_went_back_has_no_rate(sampler, tmp_path):
    sampler.sample(10.0)
    write(tmp_path, {"proc/net/dev": "a\nb\n  eth0: 5 9 0 1 0 0 0 0 2500 9 0 2 0 0 0 0\n"})
    values = sampler.sample(11.0).values
    assert "network_in" not in values
    assert values["network_out"] == 500.0


def test_a_clock_that_stands_or_goes_back_gives_no_rates(sampler):
    sampler.sample(10.0)
    assert "network_in" not in sampler.sample(10.0).values
    assert "network_in" not in sampler.sample(9.0).values


def test_what_is_not_there_has_no_value(tmp_path):
    (tmp_path / "proc").mkdir()
    sampler = HostSampler("base", proc=tmp_path / "proc", sys=tmp_path / "sys")
    assert sampler.sample(1.0).values == {}
    assert sampler.sample(2.0).values == {}


@pytest.mark.parametrize("name", [name for name in FILES if name.startswith("proc/")])
@pytest.mark.parametrize("text", ["", "\n", "garbage", "cpu x y z\n", "MemTotal:\nMemAvailable: x kB", "some avg10=\n"])
def test_garbage_costs_only_its_own_part(sampler, tmp_path, name, text):
    sampler.sample(1.0)
    write(tmp_path, {name: text})
    values = sampler.sample(2.0).values
    assert "temperature" in values
    assert len(values) >= 8


def test_a_gpu_says_what_it_knows(tmp_path):
    (tmp_path / "proc").mkdir()
    sampler = HostSampler(
        "base", proc=tmp_path / "proc", sys=tmp_path, gpu=lambda: {"gpu": 80.0, "gpu_temperature": float("nan")}
    )
    assert sampler.sample(1.0).values == {"gpu": 80.0}


def test_this_machine():
    sampler = HostSampler("here")
    sampler.sample(1.0)
    values = sampler.sample(2.0).values
    sampler.close()
    assert values["memory"] > 0
    assert values.keys() <= {key for key, signal in BY_KEY.items() if EntityKind.HOST in signal.kinds}
