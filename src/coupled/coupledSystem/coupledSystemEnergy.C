// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"
#include "contactWallFvPatchVectorField.H"
#include "syncTools.H"

// Where the power of a step goes: see stepPower in coupledSystem.H.
//
// With D_b = symm(grad U) - g N, g the growth of void, the power of a cell is
//
//     V Sigma : grad U = V [a s : D_b - a p e + a (1 - a) e N:s - p_v g + P o
//                        + 2 eta dev D : D]
//
// and of backward Euler, with Q the rotation of the step, H that of the
// objective rate (elastoViscoPlastic) and D_p the plastic part of D_b,
//
//     s : D_b dt = q d(eps_p) + (|s|^2 - |s_old|^2)/(4 G)
//                + |s - Q s_old Q^T|^2/(4 G) - s : (H - 1) : D_b dt
//     -p e dt    = (p^2 - p_old^2)/(2 K) + (p - p_old)^2/(2 K)

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::boolList Foam::coupledSystem::heldNodes() const
{
    labelList wall(mesh_.nPoints(), Zero);
    forAll(mesh_.boundary(), patchi)
    {
        if (!isA<contactWallFvPatchVectorField>(
                state_.U.boundaryField()[patchi]
            ))
            continue;
        for (const label p : mesh_.boundaryMesh()[patchi].meshPoints())
        {
            wall[p] = 1;
        }
    }
    syncTools::syncPointList(mesh_, wall, maxEqOp<label>(), label(0));

    boolList held(space_.nNodes(), true);
    forAll(wall, p)
    {
        if (wall[p]) held[space_.pointNode()[p]] = false;
    }
    return held;
}


void Foam::coupledSystem::bookPower(
    const label c,
    const cellResult& r,
    const DynamicList<scalar>& R,
    const boolList& held
)
{
    const label start = space_.cellStart()[c];
    const label n = space_.cellStart()[c + 1] - start;
    const label nd = space_.nd();
    const label* dof = &space_.cellDofs()[start];
    const scalar V = space_.V()[c];
    const scalar a = a_[c];
    const scalar p = pCell_[c];
    const scalar K = law_.elastic().K();
    const scalar G = law_.elastic().G();

    // Bolus
    elasticEnergy_[c] = 0;
    if (a > SMALL)
    {
        const symmTensor& sOld = state_.deviator[c];
        const symmTensor& s = r.r.s;
        const scalar now = magSqr(s) / (4 * G) + sqr(p) / (2 * K);
        const scalar old = magSqr(sOld) / (4 * G) + sqr(pOld_[c]) / (2 * K);
        scalar lost =
            magSqr(s - r.r.sRot) / (4 * G) + sqr(p - pOld_[c]) / (2 * K);
        if (law_.elastic().logarithmic())
        {
            const symmTensor strain =
                deltaT_ * dev(symm(r.gradU - r.growth * tensor(N_[c])));
            lost -= s && ((r.r.sTrial - r.r.sRot) / (2 * G) - strain);
        }
        const scalar rate = a * V / deltaT_;

        elasticEnergy_[c] = now * std::exp(-p / K);
        power_.elastic += rate * (now - old);
        power_.plastic += rate * r.r.q * r.r.dEpsP;
        (damaged_[c] ? power_.fracture : power_.relaxation) += rate * lost;
    }

    // Void
    const scalar dilation = -(p - pOld_[c]) / (K * deltaT_);
    const scalar rate = r.residual - r.growth;
    const scalar shear = 2 * V * magSqr(dev(symm(r.gradU)));
    const scalar etaVoid = (1 - a) * void_.eta();
    power_.voids +=
        V * (r.pv * rate + a * (1 - a) * dilation * (N_[c] && r.r.s))
        + etaVoid * shear;
    power_.debris += (eta_[c] - etaVoid) * shear;

    // Stabilisation
    const scalar* H = &space_.hourglass()[space_.hourglassStart()[c]];
    scalar qHq = 0;
    for (label i = 0; i < n; ++i)
    {
        for (label j = 0; j < n; ++j)
        {
            qHq += q_[dof[i]] * H[i * n + j] * q_[dof[j]];
        }
    }
    power_.hourglass += hourglassEta_[c] * space_.hourglassScale()[c] * qHq;
    power_.overfill += V * r.P * overfill_[c];

    // Inertia
    const scalar m = pointMass(c) / deltaT_;
    if (m > 0)
    {
        for (const label point : mesh_.cellPoints()[c])
        {
            const label s = slot(c, space_.pointNode()[point]);
            for (label k = 0; k < nd; ++k)
            {
                const scalar q = q_[dof[s + k]];
                power_.inertia +=
                    m * (q - (UOld_[c] & space_.shape(point, k))) * q;
            }
        }
    }

    // What moves nodes without being a wall
    for (label i = 0; i < n; ++i)
    {
        const label node = dof[i] / nd;
        if (held[node] && dof[i] % nd < space_.nFixed()[node])
        {
            power_.closure += R[i] * q_[dof[i]];
        }
    }
}


void Foam::coupledSystem::bookFriction(const contact& k, const scalar retained)
{
    const scalar area = k.grip * k.area;
    scalar factor, dpn, dslip;
    k.law->factor(k.pn, mag(k.slip), factor, dpn, dslip);
    power_.friction += area * factor * (k.slip & k.step) / deltaT_;
    k.law->factor(k.pn, retained, factor, dpn, dslip);
    power_.slipEnergy += 0.5 * area * factor * sqr(retained);
}


void Foam::coupledSystem::bookWalls(
    const scalarField& pressure,
    const volScalarField& wallPower
)
{
    forAll(mesh_.boundary(), patchi)
    {
        const polyPatch& pp = mesh_.boundaryMesh()[patchi];
        power_.walls += sum(wallPower.boundaryField()[patchi]);

        if (!mesh_.moving() || !isSymmetry(pp)) continue;
        const scalarField& swept = mesh_.phi().boundaryField()[patchi];
        forAll(swept, i)
        {
            power_.closure += pressure[pp.faceCells()[i]] * swept[i];
        }
    }
}

// ************************************************************************* //
