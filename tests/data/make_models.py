# SPDX-License-Identifier: BSD-3-Clause
"""Makes the tiny ONNX files of tests/data/models: one that fits the library, and some that do not.

    python tests/data/make_models.py        (needs the package onnx)

The good one calls a pixel promising in proportion to its green channel, so a test can tell what must come out.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

SIZE = 16
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


def model(
    classes: int = 3, element: int = TensorProto.UINT8, output: str = "probability", bias: float = 0.0
) -> onnx.ModelProto:
    """image / 255 → 1×1 convolution that copies the green plane into the last class."""
    weight = np.zeros((classes, 3, 1, 1), np.float32)
    weight[-1, 1] = 1.0
    shift = np.full(classes, bias, np.float32)
    nodes = [
        helper.make_node("Cast", ["image"], ["number"], to=TensorProto.FLOAT),
        helper.make_node("Div", ["number", "scale"], ["unit"]),
        helper.make_node("Conv", ["unit", "weight", "shift"], [output]),
    ]
    graph = helper.make_graph(
        nodes,
        "green",
        [helper.make_tensor_value_info("image", element, ["batch", 3, SIZE, SIZE])],
        [helper.make_tensor_value_info(output, TensorProto.FLOAT, ["batch", classes, SIZE, SIZE])],
        [
            numpy_helper.from_array(np.array(255.0, np.float32), "scale"),
            numpy_helper.from_array(weight, "weight"),
            numpy_helper.from_array(shift, "shift"),
        ],
    )
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)


def save(name: str, made: onnx.ModelProto, **changes: str | None) -> None:
    """Writes a file with METADATA; a change to None leaves the key out."""
    properties = {key: value for key, value in {**METADATA, **changes}.items() if value is not None}
    helper.set_model_props(made, properties)
    onnx.save(made, Path(__file__).parent / "models" / f"{name}.onnx")


def main() -> None:
    (Path(__file__).parent / "models").mkdir(exist_ok=True)
    save("green", model())
    save("two_classes", model(classes=2), classes="other,promising")
    save("nan", model(bias=float("nan")))
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
