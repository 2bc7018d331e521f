// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "vanDerWaals.H"

Foam::vanDerWaals::vanDerWaals(entryReader& read) :
    psi_(read.number("psi", "modulus [Pa]", entryReader::positive, 1e5)),
    lambdaM_(read.number(
        "lambdaM",
        "locking stretch [-]",
        {2, false, VGREAT, true},
        100
    )),
    a_(read.number(
        "a",
        "interaction of chains [-]",
        entryReader::nonNegative,
        0.5
    )),
    beta_(read.number(
        "beta",
        "part of the second invariant [-]",
        {0, true, 1, true},
        0
    )),
    K_(read.number("K", "bulk modulus [Pa]", entryReader::positive, 2e6))
{
    // With x = sqrt((I - 3)/2) and zeta = c x: 1 = a x (1 - c x)
    const scalar locked = sqr(lambdaM_) - 3;
    const scalar c = std::sqrt(2 / locked);
    const scalar x = a_ > 4 * c ? (1 - std::sqrt(1 - 4 * c / a_)) / (2 * c)
                                : scalar(0.99) / c;
    largest_ = 3 + 2 * sqr(x);
}


Foam::scalar Foam::vanDerWaals::invariant(
    const scalar l1,
    const scalar l2,
    const scalar l3
) const
{
    const scalar J = l1 * l2 * l3;
    const scalar s1 = sqr(l1), s2 = sqr(l2), s3 = sqr(l3);
    const scalar I1 = std::pow(J, -2.0 / 3) * (s1 + s2 + s3);
    const scalar I2 = std::pow(J, -4.0 / 3) * (s1 * s2 + s2 * s3 + s3 * s1);
    // Round-off may leave a little less than 3
    return max((1 - beta_) * I1 + beta_ * I2, scalar(3));
}


Foam::scalar Foam::vanDerWaals::energy(
    const scalar l1,
    const scalar l2,
    const scalar l3
) const
{
    const scalar J = l1 * l2 * l3;
    const scalar I = min(invariant(l1, l2, l3), largest_);
    const scalar locked = sqr(lambdaM_) - 3;
    const scalar zeta = std::sqrt((I - 3) / locked);

    return psi_
        * (-locked * (std::log1p(-zeta) + zeta)
            - 2.0 / 3 * a_ * std::pow((I - 3) / 2, 1.5))
        + 0.5 * K_ * (0.5 * (sqr(J) - 1) - std::log(J));
}


Foam::scalar Foam::vanDerWaals::thickness(
    const scalar l1,
    const scalar l2
) const
{
    // Golden section about the incompressible thickness: the energy has one
    // minimum there, within what a bulk modulus of some shear moduli allows
    const scalar golden = 0.5 * (std::sqrt(5.0) - 1);
    scalar low = 0.5 / (l1 * l2);
    scalar high = 2 / (l1 * l2);
    for (label i = 0; i < 60; ++i)
    {
        const scalar x = high - golden * (high - low);
        const scalar y = low + golden * (high - low);
        if (energy(l1, l2, x) < energy(l1, l2, y))
        {
            high = y;
        }
        else
        {
            low = x;
        }
    }
    return 0.5 * (low + high);
}


Foam::scalar Foam::vanDerWaals::membrane(const scalar l1, const scalar l2) const
{
    return energy(l1, l2, thickness(l1, l2));
}

// ************************************************************************* //
