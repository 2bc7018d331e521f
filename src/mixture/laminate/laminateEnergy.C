// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "laminate.H"
#include "volFields.H"

// Where the power of a cell goes.
//
// With D_b = symm(grad U) - (v - e - o) N and N:s = p - p_v, the power of a cell
// is
//
//     V Sigma : grad U = V [a s : D_b - a p e - p_v w + P o + 2 eta dev D : D]
//
// and of backward Euler, with Q the rotation of the step, H that of the
// objective rate (elastoViscoPlastic) and D_p the plastic part of D_b,
//
//     s : D_b dt = q d(eps_p) + (|s|^2 - |s_old|^2)/(4 G)
//                + |s - Q s_old Q^T|^2/(4 G) - s : (H - 1) : D_b dt
//     -p e dt    = (p^2 - p_old^2)/(2 K) + (p - p_old)^2/(2 K)

void Foam::laminate::declare(powerLedger& ledger)
{
    for (
        const char* name : {
            // Growth of the elastic energy of the bolus
            "elastic",
            // Stress times plastic strain rate
            "plastic",
            // Loss of backward Euler, |change of stress|^2 over twice the
            // stiffness, of intact bolus: second order in the step where
            // stress changes smoothly, and real where it falls at once
            // because a neighbour broke
            "relaxation",
            // The same of damaged bolus: elastic energy it could not hold
            "fracture",
            // Surrounding phase: p_v times its shrinking, and its viscosity
            "gas",
            // Viscosity of damaged bolus
            "damagedViscosity",
            // Expansion that works off alpha > 1; negative under pressure
            "overshoot",
        }
    )
    {
        ledger.declare(name);
    }
}


Foam::scalar Foam::laminate::book(
    const label c,
    const result& r,
    powerLedger& ledger
) const
{
    const scalar V = space_.V()[c];
    const scalar a = alphaEff_[c];
    const scalar p = r.p;
    const scalar G = law_.elastic().G();

    // Bolus
    scalar energy = 0;
    if (a > SMALL)
    {
        const symmTensor& sOld = state_.deviator[c];
        const symmTensor& s = r.r.s;
        const scalar now = magSqr(s) / (4 * G) + sqr(p) / (2 * K());
        const scalar old = magSqr(sOld) / (4 * G) + sqr(pOld_[c]) / (2 * K());
        scalar lost =
            magSqr(s - r.r.sRot) / (4 * G) + sqr(p - pOld_[c]) / (2 * K());
        if (law_.elastic().logarithmic())
        {
            const symmTensor strain =
                deltaT_ * dev(symm(ofBolus(c, r.gradU, r.apart)));
            lost -= s && ((r.r.sTrial - r.r.sRot) / (2 * G) - strain);
        }
        const scalar rate = a * V / deltaT_;

        energy = now * std::exp(-p / K());
        ledger["elastic"] += rate * (now - old);
        ledger["plastic"] += rate * r.r.q * r.r.dEpsP;
        ledger[damaged_[c] ? "fracture" : "relaxation"] += rate * lost;
    }

    // Surrounding phase
    const scalar rate = r.residual - r.growth;
    const scalar shear = 2 * V * magSqr(dev(symm(r.gradU)));
    const scalar eta = r.eta;
    const scalar etaMedium =
        damaged_[c] ? eta - a * medium_.damagedViscosity() : eta;
    ledger["gas"] += V * r.pv * rate + etaMedium * shear;
    ledger["damagedViscosity"] += (eta - etaMedium) * shear;

    ledger["overshoot"] += V * r.P * overshoot_[c];
    return energy;
}

// ************************************************************************* //
