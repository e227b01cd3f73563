"""Makes the pairs of pictures in this folder, and what the official tools say of them.

    pip install flip-evaluator==1.7 scikit-image==0.26.0 numpy pillow
    python3 tests/metrics/make.py

`expected.json` holds, for each pair (reference, test): the mean of FLIP at 67 pixels per degree, the largest value of
its map, and the mean SSIM with Gaussian weights (Wang et al. 2004).
"""
import json
import os

import flip_evaluator
import numpy as np
from PIL import Image
from skimage.metrics import structural_similarity

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT = 56, 40
y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
random = np.random.default_rng(7)


def stack(r, g, b):
    return np.stack([np.broadcast_to(c, (HEIGHT, WIDTH)) for c in (r, g, b)], axis=2)


def bytes_of(picture):
    return np.round(np.clip(picture, 0, 1) * 255).astype(np.uint8)


def ball(shift):
    d = np.hypot(x - WIDTH / 2 - shift, y - HEIGHT / 2) / 14
    shade = np.where(d < 1, np.sqrt(np.clip(1 - d * d, 0, 1)), 0.15)
    return stack(shade, shade * 0.6 + 0.1, 0.25 + 0.5 * y / HEIGHT)


gradient = stack(x / WIDTH, y / HEIGHT, 0.5)
board = ((x // 7 + y // 5) % 2) * 0.7 + 0.15
PAIRS = {
    'noise': (gradient, gradient + random.normal(0, 0.06, gradient.shape)),
    'shift': (ball(0), ball(1.5)),
    'fireflies': (ball(0), np.where(random.random((HEIGHT, WIDTH, 1)) < 0.01, 1.0, ball(0))),
    'hue': (stack(board, board * 0.5, 0.3), stack(board * 0.5, board, 0.3)),
    'blur': (stack(board, board, board), stack(*[(board + np.roll(board, 1, 0) + np.roll(board, 1, 1)) / 3] * 3)),
    'corners': (stack(0.0, 0.0, 0.0), stack(x > 40, y > 30, (x < 12) & (y < 12))),
}

expected = {}
for name, (reference, test) in PAIRS.items():
    reference, test = bytes_of(reference), bytes_of(test)
    Image.fromarray(reference).save(os.path.join(HERE, f'{name}.reference.png'), optimize=True)
    Image.fromarray(test).save(os.path.join(HERE, f'{name}.test.png'), optimize=True)
    a, b = reference.astype(np.float32) / 255, test.astype(np.float32) / 255
    flip, mean, _ = flip_evaluator.evaluate(a, b, 'LDR', applyMagma=False, parameters={'ppd': 67.0})
    ssim = structural_similarity(a, b, channel_axis=2, data_range=1.0, gaussian_weights=True, sigma=1.5,
                                 use_sample_covariance=False)
    expected[name] = {'flip': float(mean), 'flip_max': float(flip.max()), 'ssim': float(ssim)}

with open(os.path.join(HERE, 'expected.json'), 'w') as out:
    json.dump(expected, out, indent=2)
    out.write('\n')
