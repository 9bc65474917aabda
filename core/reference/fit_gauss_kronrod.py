"""Nodes and weights of the 15-point Kronrod rule and the 7-point Gauss rule inside it, in 50 digits.

Run by hand (needs mpmath): prints the table of core/quadrature.cpp: node, Kronrod weight, Gauss weight (0 for added nodes).
The added nodes are the roots of the Stieltjes polynomial E, which is orthogonal to P_7 x^k for k <= 7.
"""
import mpmath as mp

mp.mp.dps = 50
ORDER = 7


def moment(power):
    return mp.mpf(0) if power % 2 else mp.mpf(2) / (power + 1)


def inner(a, b, shift):
    return sum(x * y * moment(i + j + shift) for i, x in enumerate(a) for j, y in enumerate(b))


def legendre(order):
    return mp.taylor(lambda x: mp.legendre(order, x), 0, order)


def stieltjes(base):
    """Monic and even, of degree ORDER + 1; only the odd powers k give conditions that do not hold by parity."""
    degree = ORDER + 1
    odd, even = range(1, degree, 2), range(0, degree, 2)
    matrix = mp.matrix([[inner(base, [0] * power + [1], k) for power in even] for k in odd])
    solved = mp.lu_solve(matrix, mp.matrix([-inner(base, [0] * degree + [1], k) for k in odd]))
    return [solved[j // 2] if j % 2 == 0 else mp.mpf(0) for j in range(degree)] + [mp.mpf(1)]


def roots(polynomial):
    return sorted(mp.re(r) for r in mp.polyroots(polynomial[::-1], maxsteps=500, extraprec=400))


def weights(nodes):
    matrix = mp.matrix(len(nodes), len(nodes))
    for power in range(len(nodes)):
        for column, node in enumerate(nodes):
            matrix[power, column] = node**power
    return list(mp.lu_solve(matrix, mp.matrix([moment(power) for power in range(len(nodes))])))


if __name__ == "__main__":
    base = legendre(ORDER)
    gauss = roots(base)
    gauss_weights = dict(zip((mp.nstr(x, 20) for x in gauss), weights(gauss)))
    nodes = sorted(gauss + roots(stieltjes(base)))
    for node, weight in zip(nodes, weights(nodes)):
        if node > mp.mpf("-1e-30"):
            print(f"{{{mp.nstr(abs(node), 18)}, {mp.nstr(weight, 18)}, {mp.nstr(gauss_weights.get(mp.nstr(node, 20), 0), 18)}}},")
