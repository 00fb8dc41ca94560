# SPDX-License-Identifier: GPL-3.0-or-later
"""A deformable body that swings about an axis through a point that no mode moves: an integrator of its own, from the
terms of foreign_bodies.Body alone. Symbols as in equations.md, sections 2 and 3."""

import numpy

from foreign_bodies import skew


class Pendulum:
    def __init__(self, body, modes, node, axis, gravity, damping_ratio):
        m = range(modes)
        self.p0 = body.nodes[node][0]
        self.axis, self.gravity = numpy.array(axis) / numpy.linalg.norm(axis), numpy.array(gravity)
        self.mass, self.S1, self.J0 = body.mass, body.S1, body.J0
        self.S2, self.N0 = body.S2[:, m], body.N0[:, m]
        self.G0, self.G, self.N = body.G0[m], body.G[numpy.ix_(m, m)], body.N[numpy.ix_(m, m)]
        self.M, self.K = body.M[numpy.ix_(m, m)], body.K[numpy.ix_(m, m)]
        self.D = numpy.diag(2 * damping_ratio * numpy.sqrt(numpy.diag(self.K)))
        self.modes = modes

    def rate(self, state):
        """Of [angle, a, angle', a']; the body turns about p0, which stays where it is."""
        m = self.modes
        angle, a, speed, a_rate = state[0], state[1:1 + m], state[1 + m], state[2 + m:]
        e = skew(self.axis)
        g = (numpy.eye(3) - numpy.sin(angle) * e + (1 - numpy.cos(angle)) * e @ e) @ self.gravity  # body axes
        w = speed * self.axis
        S = self.S1 + self.S2 @ a
        G = self.G0 + numpy.tensordot(a, self.G, 1)
        J = self.J0 + sum(a[l] * (self.G0[l] + self.G0[l].T) for l in range(m))
        J = J + numpy.einsum("j,l,jlxy->xy", a, a, self.G)
        N = self.N0 + numpy.einsum("j,jlx->xl", a, self.N)
        # In body axes, with x' = A v: v = ~p0 w.
        mass = numpy.zeros((6 + m, 6 + m))
        mass[:3, :3], mass[:3, 3:6], mass[:3, 6:] = self.mass * numpy.eye(3), -skew(S), self.S2
        mass[3:6, :3], mass[3:6, 3:6], mass[3:6, 6:] = skew(S), J, N
        mass[6:, :3], mass[6:, 3:6], mass[6:, 6:] = self.S2.T, N.T, self.M
        u_t = -skew(w) @ (skew(w) @ S + 2 * self.S2 @ a_rate) + self.mass * g
        u_r = -skew(w) @ J @ w - 2 * numpy.tensordot(a_rate, G, 1) @ w + skew(S) @ g
        u_a = numpy.einsum("x,lxy,y->l", w, G, w) - 2 * numpy.einsum("x,jlx,j->l", w, self.N, a_rate)
        u_a = u_a - self.K @ a - self.D @ a_rate + self.S2.T @ g
        P = numpy.zeros((6 + m, 1 + m))
        P[:3, 0], P[3:6, 0], P[6:, 1:] = skew(self.p0) @ self.axis, self.axis, numpy.eye(m)
        turning = numpy.zeros(6 + m)  # P' of the velocities
        turning[:3] = skew(w) @ skew(self.p0) @ w
        u = numpy.concatenate([u_t, u_r, u_a])
        return numpy.concatenate([state[1 + m:], numpy.linalg.solve(P.T @ mass @ P, P.T @ (u - mass @ turning))])

    def run(self, speed, end, steps):
        """Gragg's method extrapolated by Bulirsch and Stoer, of order 12. @return angle and a at the end"""
        y = numpy.zeros(2 + 2 * self.modes)
        y[1 + self.modes] = speed
        for _ in range(steps):
            y = self.extrapolated(y, end / steps)
        return y[:1 + self.modes]

    def extrapolated(self, y, H):
        counts = (2, 4, 6, 8, 10, 12)
        table = []
        for k, n in enumerate(counts):
            h = H / n
            before, at = y, y + h * self.rate(y)
            for _ in range(1, n):
                before, at = at, before + 2 * h * self.rate(at)
            row = [(at + before + h * self.rate(at)) / 2]
            for j in range(k):
                row.append(row[j] + (row[j] - table[k - 1][j]) / ((n / counts[k - j - 1])**2 - 1))
            table.append(row)
        return table[-1][-1]
