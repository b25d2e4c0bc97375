"""What is measured in pictures of the retina."""

import math

import numpy

ARCMIN = 60 * 180 / math.pi


def looks_across(width, height, fov_deg):
    """The look (tangent) of each column and of each row's centre."""
    step = 2 * math.tan(math.radians(fov_deg / 2)) / width
    return (numpy.arange(width) + 0.5 - width / 2) * step, (height / 2 - numpy.arange(height) - 0.5) * step


def place_and_size(picture, fov_deg, mask=None):
    """Centre of the light in degrees (right, up), and width and height in degrees as four times its standard
    deviations: what moves or grows by a pixel in part moves them by that part."""
    u, v = looks_across(picture.shape[1], picture.shape[0], fov_deg)
    light = picture if mask is None else numpy.where(mask, picture, 0.0)
    columns, rows, total = light.sum(axis=0), light.sum(axis=1), light.sum()
    x_deg, y_deg = numpy.degrees(numpy.arctan(u)), numpy.degrees(numpy.arctan(v))
    x, y = (columns * x_deg).sum() / total, (rows * y_deg).sum() / total
    width = 4 * math.sqrt((columns * (x_deg - x) ** 2).sum() / total)
    height = 4 * math.sqrt((rows * (y_deg - y) ** 2).sum() / total)
    return numpy.array([x, y, width, height])


def sharpness(picture, pinhole, mask):
    """As focalstage's: the root of the ratio of squared gradients over the mask's pixels."""
    def squared(image):
        across, down = numpy.zeros_like(image), numpy.zeros_like(image)
        across[:, 1:-1] = image[:, 2:] - image[:, :-2]
        down[1:-1] = image[2:] - image[:-2]
        return (across ** 2 + down ** 2)[mask].sum()
    return math.sqrt(squared(picture) / squared(pinhole))


def peak(foci_d, values):
    """As focalstage's: the top of the parabola through the highest value and its neighbours, a level top (blur below a
    pixel) counting as one value in its middle; None at an end."""
    foci_d, values = numpy.asarray(foci_d), numpy.asarray(values)
    first = last = int(numpy.argmax(values))
    while first > 0 and values[first - 1] >= values.max() * (1 - 5e-4):
        first -= 1
    while last + 1 < len(values) and values[last + 1] >= values.max() * (1 - 5e-4):
        last += 1
    if first == 0 or last + 1 == len(values):
        return None
    middle_d = (foci_d[first] + foci_d[last]) / 2
    a, b, _ = numpy.polyfit([foci_d[first - 1] - middle_d, 0, foci_d[last + 1] - middle_d],
                            [values[first - 1], values.max(), values[last + 1]], 2)
    return middle_d - b / (2 * a)


def missing_light(strip, columns_u, from_u, to_u):
    """How wide a stripe of darkness (or, below zero, of doubled light) lies between two looks of an evenly white strip,
    as a difference of looks: the integral of what is missing, which no blur and no jagged edge changes."""
    step = columns_u[1] - columns_u[0]
    inside = (columns_u > from_u) & (columns_u < to_u)
    return float((1.0 - strip.mean(axis=0)[inside]).sum() * step)


def shift_between(picture, reference, fov_deg):
    """By how many arc minutes `picture` lies beside `reference`: the shift (right, down) that explains most of their
    difference, by least squares over the reference's gradients; good below the width of its edges."""
    down, right = numpy.gradient(reference)
    equations = numpy.stack([-right.ravel(), -down.ravel()], axis=1)
    shift_px, *_ = numpy.linalg.lstsq(equations, (picture - reference).ravel(), rcond=None)
    step = 2 * math.tan(math.radians(fov_deg / 2)) / reference.shape[1]
    return shift_px * step * ARCMIN
