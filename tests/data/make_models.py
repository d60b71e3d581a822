# SPDX-License-Identifier: BSD-3-Clause
"""Makes the tiny ONNX and TorchScript files of tests/data/models: some that fit the library, and some that do not.

    python tests/data/make_models.py        (needs the packages onnx and torch)

The good ones call a pixel promising in proportion to its green channel, so a test can tell what must come out.
"""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

import numpy as np
import onnx
import torch
from onnx import TensorProto, helper, numpy_helper
from torch import Tensor, nn

SIZE = 16
FOLDER = Path(__file__).parent / "models"
METADATA = {
    "lrrt_format": "1",
    "name": "green",
    "input_size": str(SIZE),
    "marker_side": "1",
    "classes": "free,obstacle,promising",
    "colours": json.dumps(
        {
            "start": [255, 0, 0],
            "goal": [0, 0, 255],
            "free": [255, 255, 255],
            "obstacle": [0, 0, 0],
            "promising": [0, 255, 0],
        }
    ),
    "threshold": "0.5",
    "training_data": "none",
    "training_budget": "none",
    "commit": "none",
}
SIZES = {"input_size": "32", "smaller_inputs": "8,16", "least_passage": "2"}


def model(
    classes: int = 3,
    element: int = TensorProto.UINT8,
    output: str = "probability",
    bias: float = 0.0,
    side: int | str = SIZE,
    batch: int | str = "batch",
    stride: int = 1,
    kept: tuple[int, int] | None = None,
    opset: int = 17,
) -> onnx.ModelProto:
    """image / 255 → 1×1 convolution that copies the green plane into the last class.

    ``kept``: an axis of the output and how much of it is kept, which the graph does not say: only a run tells.
    """
    shape = [batch, classes, *((side,) * 2 if stride == 1 else ("rows", "columns"))]
    strides = {} if stride == 1 else {"strides": [stride, stride]}
    weight = np.zeros((classes, 3, 1, 1), np.float32)
    weight[-1, 1] = 1.0
    shift = np.full(classes, bias, np.float32)
    nodes = [
        helper.make_node("Cast", ["image"], ["number"], to=TensorProto.FLOAT),
        helper.make_node("Div", ["number", "scale"], ["unit"]),
        helper.make_node("Conv", ["unit", "weight", "shift"], [output if kept is None else "all"], **strides),
    ]
    constants = [
        numpy_helper.from_array(np.array(255.0, np.float32), "scale"),
        numpy_helper.from_array(weight, "weight"),
        numpy_helper.from_array(shift, "shift"),
    ]
    if kept is not None:
        axis, count = kept
        shape[axis] = "kept"
        nodes.append(helper.make_node("Compress", ["all", "kept"], [output], axis=axis))
        constants.append(numpy_helper.from_array(np.ones(count, bool), "kept"))
    graph = helper.make_graph(
        nodes,
        "green",
        [helper.make_tensor_value_info("image", element, [batch, 3, side, side])],
        [helper.make_tensor_value_info(output, TensorProto.FLOAT, shape)],
        constants,
    )
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", opset)], ir_version=8)


def properties(**changes: str | None) -> dict[str, str]:
    """METADATA with changes; a change to None leaves the key out."""
    return {key: value for key, value in {**METADATA, **changes}.items() if value is not None}


def save(name: str, made: onnx.ModelProto, **changes: str | None) -> None:
    """Writes an ONNX file."""
    helper.set_model_props(made, properties(**changes))
    onnx.save(made, FOLDER / f"{name}.onnx")


class Green(nn.Module):
    """What ``model`` computes."""

    def __init__(self, classes: int = 3, bias: float = 0.0) -> None:
        super().__init__()
        self.copy = nn.Conv2d(3, classes, 1)
        nn.init.zeros_(self.copy.weight)
        nn.init.constant_(self.copy.weight[-1, 1], 1.0)
        nn.init.constant_(self.copy.bias, bias)

    def forward(self, image: Tensor) -> Tensor:
        return self.copy(image.float() / 255.0)


class Halved(Green):
    """An output of half the size."""

    def forward(self, image: Tensor) -> Tensor:
        return super().forward(image)[:, :, ::2, ::2]


class Doubled(Green):
    """An output in double precision."""

    def forward(self, image: Tensor) -> Tensor:
        return super().forward(image).double()


class Paired(Green):
    """Two outputs."""

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor]:
        return super().forward(image), image


class Masked(Green):
    """Two inputs."""

    def forward(self, image: Tensor, mask: Tensor) -> Tensor:
        return super().forward(image * mask)


class Single(Green):
    """Runs with one picture only."""

    def forward(self, image: Tensor) -> Tensor:
        return super().forward(image.reshape(1, 3, SIZE, SIZE))


class First(Green):
    """Looks at the first of its pictures only."""

    def forward(self, image: Tensor) -> Tensor:
        return super().forward(image[:1])


class FixedSize(Green):
    """Runs with pictures of one size only."""

    def forward(self, image: Tensor) -> Tensor:
        return super().forward(image + torch.zeros(1, 3, SIZE, SIZE, dtype=torch.uint8))


def save_script(name: str, module: nn.Module, metadata: str | None = None, inputs: int = 1) -> None:
    """Writes a TorchScript archive without its debug records: they are large, and name the folders of this machine."""
    traced = torch.jit.trace(module.eval(), (torch.zeros(1, 3, SIZE, SIZE, dtype=torch.uint8),) * inputs)
    whole = io.BytesIO()
    torch.jit.save(traced, whole, _extra_files={} if metadata is None else {"metadata.json": metadata})
    with zipfile.ZipFile(whole) as source, zipfile.ZipFile(FOLDER / f"{name}.pt", "w") as target:
        for record in source.namelist():
            if not record.endswith(".debug_pkl"):
                target.writestr(zipfile.ZipInfo(record), source.read(record))


def make_scripts() -> None:
    metadata = json.dumps(properties())
    save_script("green", Green(), metadata)
    save_script("sizes", Green(), json.dumps(properties(**SIZES)))
    save_script("single", Single(), metadata)
    save_script("first", First(), metadata)
    save_script("one_class", Green(classes=1), json.dumps(properties(classes="promising")))
    save_script("nan", Green(bias=float("nan")), metadata)
    save_script("no_metadata", Green())
    save_script("broken_metadata", Green(), "this is no JSON")
    save_script("number_size", Green(), json.dumps({**METADATA, "input_size": SIZE}))
    save_script("no_size", Green(), json.dumps(properties(input_size=None)))
    save_script("wrong_size", FixedSize(), json.dumps(properties(input_size="32")))
    save_script("wrong_classes", Green(), json.dumps(properties(classes="free,obstacle,wall,promising")))
    save_script("half_output", Halved(), metadata)
    save_script("double_output", Doubled(), metadata)
    save_script("two_outputs", Paired(), metadata)
    save_script("two_inputs", Masked(), metadata, inputs=2)


def main() -> None:
    FOLDER.mkdir(exist_ok=True)
    make_scripts()
    save("green", model())
    save("two_classes", model(classes=2), classes="other,promising")
    save("one_class", model(classes=1), classes="promising")
    save("single", model(batch=1))
    save("sizes", model(side="side"), **SIZES)
    save("fixed_sizes", model(side=32), **SIZES)
    save("odd_sizes", model(side="side"), **{**SIZES, "smaller_inputs": "16,8"})
    save("no_passage", model(side="side"), **{**SIZES, "least_passage": None})
    save("nan", model(bias=float("nan")))
    save("infinite", model(bias=float("inf")))
    save("loud", model(bias=2.0))
    save("negative", model(bias=-1.0))
    save("half_output", model(stride=2))
    save("cut_output", model(kept=(2, SIZE // 2)))
    save("open_classes", model(kept=(1, 3)))
    save("wrong_opset", model(opset=999))
    save("two_promising", model(), classes="free,promising,promising")
    save("float_input", model(element=TensorProto.FLOAT))
    save("other_output", model(output="scores"))
    save("no_size", model(), input_size=None)
    save("wrong_size", model(), input_size="32")
    save("odd_size", model(), input_size="many")
    save("wrong_classes", model(), classes="free,obstacle,wall,promising")
    save("no_promising", model(), classes="free,obstacle,path")
    save("wrong_format", model(), lrrt_format="99")
    save("wrong_colours", model(), colours="red")
    save("wrong_threshold", model(), threshold="2")


if __name__ == "__main__":
    main()
