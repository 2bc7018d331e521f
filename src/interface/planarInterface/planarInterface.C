// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "planarInterface.H"

Foam::scalar Foam::planarInterface::area(scalar m1, scalar m2, const scalar d)
{
    m1 = max(m1, scalar(1e-6));
    m2 = max(m2, scalar(1e-6));
    auto corner = [](const scalar z) { return z > 0 ? z * z : 0; };
    const scalar twice =
        corner(d) - corner(d - m1) - corner(d - m2) + corner(d - m1 - m2);
    return min(max(0.5 * twice / (m1 * m2), scalar(0)), scalar(1));
}


Foam::scalar Foam::planarInterface::offset(
    const scalar m1,
    const scalar m2,
    const scalar alpha
)
{
    const scalar less = min(alpha, 1 - alpha);
    const scalar small = min(m1, m2);
    const scalar large = max(m1, m2);
    const scalar d = 2 * large * less < small
        ? std::sqrt(2 * less * small * large)
        : less * large + 0.5 * small;
    return alpha > 0.5 ? 1 - d : d;
}


Foam::scalar Foam::planarInterface::swept(
    const scalar alpha,
    const scalar along,
    const scalar across,
    const scalar part
)
{
    const scalar change = mag(along) + across;
    if (change < VSMALL) return alpha;
    const scalar m1 = mag(along) / change;
    const scalar m2 = across / change;
    const scalar d = offset(m1, m2, alpha);

    // The bolus is at the face, or on the other side
    return area(m1 * part, m2, along > 0 ? d : d - m1 * (1 - part));
}

// ************************************************************************* //
