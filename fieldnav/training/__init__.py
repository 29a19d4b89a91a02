"""Training of a small network for crop rows from pictures that it draws itself, never from photographs.

`python -m fieldnav.training` draws, trains and writes an ONNX file. Only `network`, `train` and `export` need
PyTorch and onnx (the extra `training`); the rest needs numpy and OpenCV.
"""
