"""Closed forms that the pictures are held against: the thin lens of a viewer's eye, written anew from its geometry.

Coordinates are metres about the viewer: +X to the right, +Y up, the eye looks along -Z. A look is (x, y) at z = -1 from
the pupil.
"""

import math

import numpy

HALF_IPD_M = 0.0315


class EyeLens:
    """The left eye's pupil at E and its lens d_e before it."""

    def __init__(self, lens_to_pupil_m, pupil_z_m=0.0):
        self.d_e = lens_to_pupil_m
        self.pupil = numpy.array([-HALF_IPD_M, 0.0, pupil_z_m])
        self.lens = self.pupil + [0.0, 0.0, -lens_to_pupil_m]

    def meet(self, look, plane):
        """Where the straight look meets a plane (point, normal)."""
        direction = numpy.array([look[0], look[1], -1.0])
        point, normal = plane
        return self.pupil + direction * (numpy.dot(normal, point - self.pupil) / numpy.dot(normal, direction))

    def distance(self, point):
        """Axial, from the lens."""
        return self.lens[2] - point[2]

    def seen(self, point, power_d):
        """The look in which a point appears through the lens: a ray from it through the lens at height h leaves towards
        the pupil if its slope there changes by h v. With the point at X off the axis and d before the lens, the ray's
        slopes are (h - X) / d before and -h / d_e after: -h / d_e = (h - X) / d - h v, so h = X / (1 + d / d_e - v d)
        and the look is h / d_e."""
        d = self.distance(point)
        off_axis = numpy.array([point[0] - self.lens[0], point[1] - self.lens[1]])
        return off_axis / (self.d_e + d - power_d * d * self.d_e)

    def straight(self, point):
        return numpy.array([point[0] - self.pupil[0], point[1] - self.pupil[1]]) / (self.pupil[2] - point[2])


def projector_pixel(projector, world_m):
    """Of points [..., 3], for a projector without distortion, as the project file describes it."""
    x, y, z, w = projector["rotation_xyzw"]
    rotation = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    p = (numpy.asarray(world_m) - projector["position_m"]) @ rotation  # by its transpose
    return numpy.stack([projector["cx_px"] + projector["fx_px"] * p[..., 0] / -p[..., 2],
                        projector["cy_px"] - projector["fy_px"] * p[..., 1] / -p[..., 2]], axis=-1)


def turned_plane(centre_m, about_y_rad):
    """A plane that faced +Z, turned about the vertical."""
    return numpy.array(centre_m, float), numpy.array([math.sin(about_y_rad), 0.0, math.cos(about_y_rad)])


def bisect(function, low, high):
    """Where a rising function is zero."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return (low + high) / 2
