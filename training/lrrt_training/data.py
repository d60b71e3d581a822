# SPDX-License-Identifier: BSD-3-Clause
"""Training samples: a scene becomes network input and label, by the library's own encoder; and the curriculum."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import lightning
import numpy as np
import torch
from torch.utils.data import DataLoader, Dataset, Sampler

import lrrt

from .families import FAMILIES
from .families.external import ExternalMaps
from .metrics import OBSTACLE
from .scenes import Scene, SceneSource
from .store import SPLITS, MazeStore

MARKER_SIDE = 5  #: least side of the start and goal markers, in pixels of the network's input
_WARM_UP = 0.03  #: share of a stage in which the learning rate rises


@dataclass
class Stage:
    """One step of the curriculum. Every batch mixes its levels, families and external maps."""

    size: int  #: side of the network's input, pixels
    samples: int  #: length
    batch_size: int  #: samples a batch of one process
    levels: list[int]  #: maze levels, blocks a side
    learning_rate: float = 1e-3  #: highest
    pixel_share: float = 0.5  #: share of the mazes with several map pixels a block
    braided_share: float = 0.0  #: share of the mazes that get more loops than they have in the store
    family_share: float = 0.0  #: share of the samples from map families
    families: list[str] = field(
        default_factory=lambda: list(FAMILIES)
    )  #: drawn from; one named twice comes twice as often
    external_share: float = 0.0  #: share of the samples from external maps (0 where there are none)
    other_sizes: list[int] = field(default_factory=list)  #: sides that batches take in turn with ``size``
    least_block: float = 0.0  #: a maze is shown only at sides that give its blocks so many pixels

    def __post_init__(self) -> None:
        unknown = sorted(set(self.families) - set(FAMILIES))
        if unknown or not self.families:
            raise ValueError(f"families {unknown}: expected at least one of {', '.join(FAMILIES)}")
        if self.other_sizes and self.least_block < 1:
            raise ValueError(f"least_block = {self.least_block}: expected at least 1 where there are other_sizes")
        for size in self.sizes:
            if not self.levels_at(size):
                raise ValueError(f"least_block = {self.least_block}: no level of {self.levels} fits side {size}")

    @property
    def sizes(self) -> list[int]:
        """Sides of the network's input, in the order in which batches take them."""
        return [self.size, *self.other_sizes]

    def size_at(self, sample: int) -> int:
        """Side of the network's input for a sample, counted from the stage's first."""
        return self.sizes[sample // self.batch_size % len(self.sizes)]

    def levels_at(self, size: int) -> list[int]:
        """Maze levels that a side has room for."""
        return [level for level in self.levels if size >= self.least_block * level]

    def learning_rate_at(self, progress: float) -> float:
        """Learning rate at a share of the stage in [0, 1]: a short rise, then half a cosine down to 0."""
        rise = min(1.0, progress / _WARM_UP + 0.02)
        return float(self.learning_rate * rise * 0.5 * (1.0 + np.cos(np.pi * min(1.0, progress))))


@dataclass(frozen=True)
class Curriculum:
    """Stages one after the other, with all samples numbered through."""

    stages: list[Stage] = field(default_factory=list)

    @property
    def samples(self) -> int:
        return sum(stage.samples for stage in self.stages)

    def begin(self, number: int) -> int:
        """Number of the first sample of a stage."""
        return sum(stage.samples for stage in self.stages[:number])

    def stage_at(self, sample: int) -> int:
        """Number of the stage of a sample."""
        for number in range(len(self.stages)):
            if sample < self.begin(number + 1):
                return number
        raise IndexError(f"sample {sample}: the curriculum has {self.samples}")

    def learning_rate_at(self, sample: int) -> float:
        number = self.stage_at(sample)
        return self.stages[number].learning_rate_at((sample - self.begin(number)) / self.stages[number].samples)

    def size_at(self, sample: int) -> int:
        """Side of the network's input for a sample."""
        number = self.stage_at(sample)
        return self.stages[number].size_at(sample - self.begin(number))


def encoded(encoder: lrrt.Encoder, scene: Scene) -> dict[str, torch.Tensor]:
    """A scene as the network sees it: ``image`` (3, S, S) uint8 and ``label`` (S, S) uint8 classes."""
    encoding = encoder.encode(scene.occupancy_map(), scene.start, scene.goal)
    return {
        "image": torch.from_numpy(np.array(encoding.image)),
        "label": torch.from_numpy(np.array(encoding.to_input(scene.label(encoding.scale), fill=OBSTACLE))),
    }


class SceneDataset(Dataset):
    """Sample i of a curriculum is a function of (seed, split, i) alone. An item has the keys of ``encoded`` and
    ``index``, the number of the sample."""

    def __init__(self, curriculum: Curriculum, source: SceneSource, seed: int = 1) -> None:
        self.curriculum, self.source, self.seed = curriculum, source, seed
        self._encoders: dict[int, lrrt.Encoder] = {}

    def __len__(self) -> int:
        return self.curriculum.samples

    def scene(self, index: int) -> Scene:
        """The planning problem of a sample."""
        rng = np.random.default_rng([self.seed, SPLITS.index(self.source.split), index])
        stage = self.curriculum.stages[self.curriculum.stage_at(index)]
        size = self.curriculum.size_at(index)
        outside = self.source.external.names()
        draw = rng.random()
        if draw < stage.family_share:
            return self.source.family(rng, _one_of(rng, stage.families), size)
        if outside and draw < stage.family_share + stage.external_share:
            return self.source.outside(rng, _one_of(rng, outside))
        level = _one_of(rng, stage.levels_at(size))
        return self.source.maze(rng, level, size, stage.pixel_share, braided_share=stage.braided_share)

    def __getitem__(self, index: int) -> dict[str, Any]:
        size = self.curriculum.size_at(index)
        if size not in self._encoders:
            self._encoders[size] = lrrt.Encoder(size=size, marker_side=MARKER_SIDE)
        return {**encoded(self._encoders[size], self.scene(index)), "index": index}


def _one_of(rng: np.random.Generator, items: list[Any]) -> Any:
    return items[int(rng.integers(len(items)))]


class CurriculumBatches(Sampler[list[int]]):
    """Consecutive sample numbers from ``first`` on, in batches that never mix stages; each process of a distributed run
    takes its share of every step. What does not fill a step at the end of a stage is left out."""

    def __init__(self, curriculum: Curriculum, first: int = 0, rank: int = 0, processes: int = 1) -> None:
        self.curriculum, self.first, self.rank, self.processes = curriculum, first, rank, processes

    def __len__(self) -> int:
        """Steps of the whole curriculum, those before ``first`` included, as Lightning counts them."""
        return sum(stage.samples // (stage.batch_size * self.processes) for stage in self.curriculum.stages)

    def __iter__(self) -> Iterator[list[int]]:
        for number, stage in enumerate(self.curriculum.stages):
            step = stage.batch_size * self.processes
            begin, end = self.curriculum.begin(number), self.curriculum.begin(number + 1)
            skipped = max(0, -(-(self.first - begin) // step))
            for at in range(begin + skipped * step, end - step + 1, step):
                mine = at + self.rank * stage.batch_size
                yield list(range(mine, mine + stage.batch_size))


class RegionData(lightning.LightningDataModule):
    """The samples of a training run.

    Args:
        stages: the curriculum.
        folder: where the mazes are kept; what is missing is generated.
        external: folder with maps of other sources (see ExternalMaps); may be empty or absent.
        seed: seed of the samples (the mazes have the store's).
        workers: processes that make samples.
    """

    def __init__(
        self,
        stages: list[Stage],
        folder: Path = Path("data_cache"),
        external: Path = Path("../../shared/maps"),
        seed: int = 1,
        workers: int = 1,
    ) -> None:
        super().__init__()
        self.curriculum = Curriculum(stages)
        self.folder, self.external, self.seed, self.workers = folder, external, seed, workers
        self.first = 0  #: number of the first sample to come

    def prepare_data(self) -> None:
        MazeStore(self.folder).generate(sorted({m for s in self.curriculum.stages for m in s.levels}), ("train",))

    def dataset(self) -> SceneDataset:
        source = SceneSource(MazeStore(self.folder), ExternalMaps(self.external), "train")
        return SceneDataset(self.curriculum, source, self.seed)

    def train_dataloader(self) -> DataLoader:
        batches = CurriculumBatches(self.curriculum, self.first, self.trainer.global_rank, self.trainer.world_size)
        context = "spawn" if self.workers else None  # a fork may wait for ever for a lock that another thread held
        return DataLoader(
            self.dataset(), batch_sampler=batches, num_workers=self.workers, multiprocessing_context=context
        )

    def class_frequencies(self, samples: int = 200) -> list[float]:
        """Shares of the pixels of the three classes over samples of the last stage."""
        dataset, counts = self.dataset(), np.zeros(3)
        last = len(self.curriculum.stages) - 1
        begin = self.curriculum.begin(last)
        for i in range(min(samples, self.curriculum.stages[last].samples)):
            counts += np.bincount(dataset[begin + i]["label"].numpy().ravel(), minlength=3)
        return list(counts / counts.sum())

    def pictures(self, count: int, size: int = 0) -> torch.Tensor:
        """(N, 3, S, S) uint8, network inputs of scenes spread over the last stage; S is ``size`` or the stage's. Where
        the stage has samples of that side, it is their scenes."""
        dataset, last = self.dataset(), len(self.curriculum.stages) - 1
        begin, stage = self.curriculum.begin(last), self.curriculum.stages[last]
        size = size or stage.size
        encoder = lrrt.Encoder(size=size, marker_side=MARKER_SIDE)
        fitting = [i for i in range(stage.samples) if stage.size_at(i) == size or size not in stage.sizes]
        scenes = (dataset.scene(begin + fitting[i * len(fitting) // count]) for i in range(count))
        return torch.stack([encoded(encoder, scene)["image"] for scene in scenes])

    def state_dict(self) -> dict[str, Any]:
        return {"first": self.first}

    def load_state_dict(self, state: dict[str, Any]) -> None:
        self.first = int(state["first"])
