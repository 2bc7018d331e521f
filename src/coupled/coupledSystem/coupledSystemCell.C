// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"

// Residuals and tangent of one cell: see the equations in coupledSystem.H

void Foam::coupledSystem::evaluate(const label c, cellResult& r) const
{
    const label start = space_.cellStart()[c];
    const label end = space_.cellStart()[c + 1];
    const scalar K = law_.elastic().K();

    r.gradU = Zero;
    scalar div = space_.wallFlux()[c];
    for (label i = start; i < end; ++i)
    {
        const scalar q = q_[space_.cellDofs()[i]];
        r.gradU += q * space_.G()[i];
        div += q * space_.h()[i];
    }
    div /= space_.V()[c];

    const scalar a = a_[c];
    const scalar p = pCell_[c];
    const scalar dilation = -(p - pOld_[c]) / (K * deltaT_);
    r.growth = div - a * dilation - overfill_[c];

    if (a > SMALL)
    {
        law_.update(
            seen(r.gradU - r.growth * tensor(N_[c])),
            deltaT_,
            state_.deviator[c],
            state_.epsilonPEq[c],
            damaged_[c],
            r.r
        );
    }
    else
    {
        r.r.s = Zero;
    }

    r.pv = p - (N_[c] && r.r.s);
    scalar rate;
    void_.rate(
        r.pv, a, room_[c], phi_[c], deltaT_, cohesion_[c], rate, r.drdpv
    );
    r.residual = r.growth + rate;

    r.P = -(a * p + (1 - a) * r.pv);
    r.dev = a * r.r.s + (2 * eta_[c]) * dev(symm(r.gradU));
}


Foam::symmTensor Foam::coupledSystem::turned(
    const label c,
    const cellResult& r
) const
{
    elastoViscoPlastic::response whole;
    law_.update(
        r.gradU - r.growth * tensor(N_[c]),
        deltaT_,
        state_.deviator[c],
        state_.epsilonPEq[c],
        damaged_[c],
        whole
    );
    return mag(r.r.s) / max(mag(whole.s), VSMALL) * whole.s;
}


Foam::scalar Foam::coupledSystem::pointMass(const label c) const
{
    return inertia_ > 0 ? inertia_ * law_.rho() * state_.mass[c] * space_.V()[c]
            / mesh_.cellPoints()[c].size()
                        : 0;
}


Foam::label Foam::coupledSystem::slot(const label c, const label node) const
{
    label s = space_.cellStart()[c];
    while (space_.cellDofs()[s] != space_.nd() * node) s += space_.nd();
    return s - space_.cellStart()[c];
}


void Foam::coupledSystem::internalForce(
    const label c,
    const cellResult& r,
    DynamicList<scalar>& R
) const
{
    const label start = space_.cellStart()[c];
    const label n = space_.cellStart()[c + 1] - start;
    const label* dof = &space_.cellDofs()[start];
    const scalar V = space_.V()[c];

    const scalar* H = &space_.hourglass()[space_.hourglassStart()[c]];
    const scalar kappa = hourglassEta_[c] * space_.hourglassScale()[c];

    R.setSize(n);
    for (label i = 0; i < n; ++i)
    {
        R[i] = V * (r.dev && symm(space_.G()[start + i]))
            + r.P * space_.h()[start + i];
        for (label j = 0; j < n; ++j) R[i] += kappa * H[i * n + j] * q_[dof[j]];
    }

    // Inertia: the points share the cell's mass
    const scalar m = pointMass(c) / deltaT_;
    if (m > 0)
    {
        for (const label p : mesh_.cellPoints()[c])
        {
            const label s = slot(c, space_.pointNode()[p]);
            for (label k = 0; k < space_.nd(); ++k)
            {
                R[s + k] +=
                    m * (q_[dof[s + k]] - (UOld_[c] & space_.shape(p, k)));
            }
        }
    }
}


bool Foam::coupledSystem::evaluateContact(
    const label c,
    const label fi,
    const cellResult& r,
    contact& k
) const
{
    // The void does not rub: bolus does, on its part of the face
    k.grip = a_[c];
    if (k.grip == 0) return false;

    const label facei = contactFaces_[c][fi];
    const label patchi = contactPatches_[c][fi];
    const face& f = mesh_.faces()[facei];

    k.n = Zero;
    forAll(f, fp) k.n += space_.faceWeight(facei, fp);
    if (space_.nd() == 2) k.n -= (k.n & space_.normal()) * space_.normal();
    k.n /= mag(k.n);

    k.pn = lagged_ ? state_.p[c] - (k.n & state_.deviator[c] & k.n)
                   : pCell_[c] - (k.n & r.r.s & k.n);
    if (k.pn <= 0) return false;

    k.law = friction_[patchi];
    k.weight.setSize(f.size());
    k.area = 0;
    vector v = Zero;
    vector vLast = Zero;
    forAll(f, fp)
    {
        const label node = space_.pointNode()[f[fp]];
        k.weight[fp] = mag(space_.faceWeight(facei, fp));
        k.area += k.weight[fp];
        for (label i = space_.nFixed()[node]; i < space_.nd(); ++i)
        {
            const label dof = space_.nd() * node + i;
            const vector& e = space_.basis()[node][i];
            v += k.weight[fp] * (q_[dof] - space_.fixedValue(node, i)) * e;
            vLast += k.weight[fp] * (qLast_[dof] - q_[dof]) * e;
        }
    }
    v -= (v & k.n) * k.n;

    // What the contact remembers, turned with the wall
    const label i = facei - mesh_.boundaryMesh()[patchi].start();
    vector g = elasticSlip_.boundaryField()[patchi][i];
    const scalar magG = mag(g);
    g -= (g & k.n) * k.n;
    if (mag(g) > VSMALL) g *= magG / mag(g);

    k.step = (deltaT_ / k.area) * v;
    k.slip = g + k.step;
    k.change = deltaT_ / k.area * mag(vLast);
    return true;
}


void Foam::coupledSystem::solvePressure(const label c)
{
    const scalar given = pCell_[c];
    scalar lower = -GREAT;
    scalar upper = GREAT;
    cellResult r;
    for (label i = 0; i < 50; ++i)
    {
        evaluate(c, r);
        if (mag(r.residual) < 1e-3 * tolerance_ * rate0_) break;

        // The residual grows with the pressure
        (r.residual < 0 ? lower : upper) = pCell_[c];

        const scalar dGrowth = a_[c] / (law_.elastic().K() * deltaT_);
        scalar dPv = 1;
        if (a_[c] > SMALL)
        {
            dPv -= N_[c] && law_.tangent(-dGrowth * tensor(N_[c]), r.r);
        }
        scalar p = pCell_[c] - r.residual / (dGrowth + r.drdpv * dPv);
        if (!(p > lower && p < upper)) p = 0.5 * (lower + upper);
        if (p == pCell_[c]) break;
        pCell_[c] = p;
    }

    // Where the room is used up it would rise without bounds
    if (r.pv > closingPressure_)
    {
        pCell_[c] = max(given, pCell_[c] - (r.pv - closingPressure_));
    }
}


void Foam::coupledSystem::closeVoid(
    const label c,
    const cellResult& r,
    scalar& slope,
    scalar& excess
) const
{
    slope = r.drdpv;
    excess = 0;
    if (!secant_ || r.growth >= 0) return;

    const scalar pv = void_.closingPressure(
        -r.growth, closingPressure_, a_[c], room_[c], phi_[c], deltaT_
    );
    // Nearer than that, the tangent leads there in one or two iterations
    if (pv <= 3 * max(r.pv, scalar(0))) return;

    scalar rate;
    void_.rate(
        pv, a_[c], room_[c], phi_[c], deltaT_, cohesion_[c], rate, slope
    );
    excess = r.growth + rate + slope * (r.pv - pv) - r.residual;
}


void Foam::coupledSystem::followTurn(const label c, cellResult& r) const
{
    // Void has no stress
    if (a_[c] <= SMALL) return;

    const scalar along = r.r.s && sLast_[c];
    const scalar norms = mag(r.r.s) * mag(sLast_[c]);
    sLast_[c] = r.r.s;

    if (secant_ && r.r.dEpsP > 0 && along < secantCos_ * norms)
    {
        r.r.dqdqTrial = r.r.theta;
    }
}


void Foam::coupledSystem::assembleCell(
    const label c,
    DynamicList<scalar>& R,
    cellTangent* tangent
) const
{
    scalarField* J = tangent ? &tangent->J : nullptr;
    const label start = space_.cellStart()[c];
    const label n = space_.cellStart()[c + 1] - start;
    const label nd = space_.nd();
    const tensor* G = &space_.G()[start];
    const scalar* h = &space_.h()[start];
    const scalar V = space_.V()[c];
    const scalar a = a_[c];
    const scalar K = law_.elastic().K();

    cellResult r;
    evaluate(c, r);

    internalForce(c, r, R);
    R.append(r.residual);

    // Derivatives in the direction of each unknown; the last is the pressure
    if (J)
    {
        followTurn(c, r);
        scalar slope;
        closeVoid(c, r, slope, tangent->excess);

        J->setSize((n + 1) * (n + 1));
        symG_.setSize(n);
        dDev_.setSize(n + 1);
        dP_.setSize(n + 1);
        dPv_.setSize(n + 1);
        dS_.setSize(n + 1);
        const tensor N(N_[c]);
        for (label i = 0; i < n; ++i) symG_[i] = symm(G[i]);
        for (label j = 0; j <= n; ++j)
        {
            const bool isP = j == n;
            const scalar dGrowth = isP ? a / (K * deltaT_) : h[j] / V;

            dS_[j] = Zero;
            if (a > SMALL)
            {
                dS_[j] = law_.tangent(
                    seen(isP ? -dGrowth * N : G[j] - dGrowth * N), r.r
                );
            }
            dPv_[j] = (isP ? 1 : 0) - (N_[c] && dS_[j]);
            dP_[j] = -((isP ? a : 0) + (1 - a) * dPv_[j]);
            dDev_[j] = (a * V) * dS_[j];
            if (!isP) dDev_[j] += (2 * V * eta_[c]) * dev(symG_[j]);

            (*J)[n * (n + 1) + j] = dGrowth + slope * dPv_[j];
        }
        for (label i = 0; i < n; ++i)
        {
            scalar* row = &(*J)[i * (n + 1)];
            for (label j = 0; j <= n; ++j)
            {
                row[j] = (dDev_[j] && symG_[i]) + dP_[j] * h[i];
            }
        }
    }

    if (J)
    {
        // Hourglass control and inertia
        const scalar* H = &space_.hourglass()[space_.hourglassStart()[c]];
        const scalar kappa = hourglassEta_[c] * space_.hourglassScale()[c];
        const scalar m = pointMass(c) / deltaT_;
        for (label i = 0; i < n; ++i)
        {
            for (label j = 0; j < n; ++j)
            {
                (*J)[i * (n + 1) + j] += kappa * H[i * n + j];
            }
        }
        if (m > 0)
        {
            for (const label p : mesh_.cellPoints()[c])
            {
                const label s = slot(c, space_.pointNode()[p]);
                for (label k = 0; k < nd; ++k)
                {
                    (*J)[(s + k) * (n + 1) + s + k] += m;
                }
            }
        }
    }

    // Friction on the cell's wall faces
    forAll(contactFaces_[c], fi)
    {
        contact k;
        if (!evaluateContact(c, fi, r, k)) continue;

        const face& f = mesh_.faces()[contactFaces_[c][fi]];
        const scalar slip = mag(k.slip);

        scalar factor, dpn, dslip;
        k.law->factor(k.pn, slip, factor, dpn, dslip);
        if (lagged_) dpn = 0;

        // From slip to stick the tangent throws the face far to the other
        // side; the secant leads there safely. The tangent is for faces that
        // have found their slip, and for those that begin to slip.
        if (secant_ && k.change > 0.3 * slip) dslip = 0;

        forAll(f, fp)
        {
            const label node = space_.pointNode()[f[fp]];
            const label s = slot(c, node);
            for (label i = space_.nFixed()[node]; i < nd; ++i)
            {
                const scalar w = k.grip * k.weight[fp];
                const scalar along = k.slip & space_.basis()[node][i];
                R[s + i] += w * factor * along;
                if (!J) continue;

                scalar* row = &(*J)[(s + i) * (n + 1)];
                forAll(f, gp)
                {
                    const label other = space_.pointNode()[f[gp]];
                    const label t = slot(c, other);
                    for (label j = space_.nFixed()[other]; j < nd; ++j)
                    {
                        vector d = space_.basis()[other][j];
                        d = (deltaT_ * k.weight[gp] / k.area)
                            * (d - (d & k.n) * k.n);
                        row[t + j] += w
                            * (factor * (d & space_.basis()[node][i])
                                + dslip * along * (k.slip & d)
                                    / max(slip, VSMALL));
                    }
                }
                if (dpn == 0) continue;
                for (label j = 0; j <= n; ++j)
                {
                    row[j] += w * dpn * along
                        * ((j == n ? 1 : 0) - (k.n & dS_[j] & k.n));
                }
            }
        }
    }
}

// ************************************************************************* //
