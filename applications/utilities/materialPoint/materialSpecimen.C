// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "materialSpecimen.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::materialSpecimen::loading>
    Foam::materialSpecimen::loadingNames({
        {loading::uniaxial, "uniaxial"},
        {loading::uniaxialStrain, "uniaxialStrain"},
        {loading::simpleShear, "simpleShear"},
    });


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::materialSpecimen::pressure(
    const scalar volumeStrain,
    const scalar dt,
    scalar& dpdVolumeStrain,
    scalar& opening
) const
{
    const scalar K = material_.elastic().K();

    if (now_.damaged)
    {
        // Backward Euler in the opening
        const scalar KOpening = K / (1 + K * dt / openingViscosity_);
        const scalar p = -KOpening * (volumeStrain - now_.opening);

        opening = now_.opening - dt * p / openingViscosity_;
        dpdVolumeStrain = -KOpening;

        if (opening > 0)
        {
            return p;
        }
    }

    opening = 0;
    dpdVolumeStrain = -K;

    return -K * volumeStrain;
}


Foam::materialSpecimen::state Foam::materialSpecimen::stepped(
    const tensor& gradU,
    const scalar dt
) const
{
    elastoViscoPlastic::response r;
    material_.update(gradU, dt, now_.s, now_.epsP, now_.damaged, r);

    state next(now_);
    next.t += dt;
    next.strain += dt * gradU;
    next.s = r.s;
    next.epsP = r.epsP;
    next.gradU = gradU;
    next.dEpsP = r.dEpsP;

    scalar unused;
    next.p = pressure(tr(next.strain), dt, unused, next.opening);

    return next;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::materialSpecimen::materialSpecimen(
    const dictionary& bolusProperties,
    const scalar openingViscosity
) :
    material_(bolusProperties),
    openingViscosity_(openingViscosity),
    now_(
        {0, tensor::zero, symmTensor::zero, 0, 0, 0, 0, false, tensor::zero, 0}
    )
{}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

Foam::scalar Foam::materialSpecimen::state::triaxiality() const
{
    const scalar sigmaEq = elastoViscoPlastic::sigmaEq(s);

    return sigmaEq > 0 ? -p / sigmaEq : 0;
}


Foam::scalar Foam::materialSpecimen::strain(const loading mode, const state& at)
{
    return mode == loading::simpleShear ? at.strain.yx() : at.strain.xx();
}


Foam::scalar Foam::materialSpecimen::stress(const loading mode, const state& at)
{
    return mode == loading::simpleShear ? at.s.xy() : at.s.xx() - at.p;
}


Foam::materialSpecimen::state Foam::materialSpecimen::trial(
    const loading mode,
    const scalar rate,
    const scalar dt
) const
{
    tensor gradU(tensor::zero);

    if (mode == loading::simpleShear)
    {
        gradU.yx() = rate;
        return stepped(gradU, dt);
    }

    gradU.xx() = rate;

    if (mode == loading::uniaxialStrain)
    {
        return stepped(gradU, dt);
    }

    // Uniaxial stress: start from the lateral rates of the last step
    const scalar lastRate = now_.gradU.xx();
    const scalar ratio = lastRate != 0 ? rate / lastRate : rate != 0 ? 0 : 1;
    gradU.yy() = ratio * now_.gradU.yy();
    gradU.zz() = ratio * now_.gradU.zz();

    scalar lastError = GREAT;
    tensor lastGradU(gradU);

    for (label iter = 0; iter < 500; ++iter)
    {
        elastoViscoPlastic::response r;
        material_.update(gradU, dt, now_.s, now_.epsP, now_.damaged, r);

        scalar dp, unused;
        const scalar p =
            pressure(tr(now_.strain) + dt * tr(gradU), dt, dp, unused);

        const scalar fy = r.s.yy() - p;
        const scalar fz = r.s.zz() - p;
        const scalar error = std::abs(fy) + std::abs(fz);

        // Roundoff: of the stresses, and of the strain behind the pressure
        const scalar roundoff = 1e-12 * (r.qTrial + std::abs(p))
            + SMALL * material_.elastic().K() * (1 + mag(now_.strain));

        if (error <= roundoff)
        {
            return stepped(gradU, dt);
        }

        if (error > (1 - 1e-4) * lastError && iter < 400)
        {
            // The last Newton step was too long
            gradU = 0.5 * (gradU + lastGradU);
            continue;
        }

        const symmTensor dsy =
            material_.tangent(tensor(0, 0, 0, 0, 1, 0, 0, 0, 0), r);
        const symmTensor dsz =
            material_.tangent(tensor(0, 0, 0, 0, 0, 0, 0, 0, 1), r);

        const scalar Jyy = dsy.yy() - dt * dp;
        const scalar Jyz = dsz.yy() - dt * dp;
        const scalar Jzy = dsy.zz() - dt * dp;
        const scalar Jzz = dsz.zz() - dt * dp;
        const scalar det = Jyy * Jzz - Jyz * Jzy;

        lastError = error;
        lastGradU = gradU;
        gradU.yy() -= (Jzz * fy - Jyz * fz) / det;
        gradU.zz() -= (Jyy * fz - Jzy * fy) / det;
    }

    FatalErrorInFunction
        << "No lateral strain rate makes the lateral stress zero at t = "
        << now_.t << " s, axial rate " << rate << " 1/s, dt " << dt << " s"
        << exit(FatalError);

    return now_;
}


void Foam::materialSpecimen::accept(const state& next)
{
    const damageModel& damage = material_.damage();
    const scalar eta = next.triaxiality();
    const scalar strain = next.epsP - now_.epsP;
    const scalar tensile =
        now_.tensileStrain + (damage.tension(eta) ? strain : scalar(0));

    now_ = next;
    now_.tensileStrain = tensile;
    now_.damaged = now_.damaged || damage.onset(now_.epsP, tensile, eta);
}


Foam::materialSpecimen::comparison Foam::materialSpecimen::compareTangent(
    const scalar dt
) const
{
    // No symmetry and no special direction
    const tensor disturbance(
        0.31, -0.72, 0.44, 0.93, -0.58, 0.26, -0.37, 0.69, 0.15
    );

    comparison result = {0, 0};

    for (const scalar size : {max(mag(now_.gradU), 1e-5 / dt), 0.2 / dt})
    {
        const tensor gradU(now_.gradU + size * disturbance);
        const scalar h = 3e-4 * mag(gradU);

        elastoViscoPlastic::response r;
        material_.update(gradU, dt, now_.s, now_.epsP, now_.damaged, r);

        symmTensor exact[tensor::nComponents];
        scalar largest = 0;

        for (direction cmpt = 0; cmpt < tensor::nComponents; ++cmpt)
        {
            tensor d(tensor::zero);
            d[cmpt] = 1;
            exact[cmpt] = material_.tangent(d, r);
            largest = max(largest, mag(exact[cmpt]));
        }

        for (direction cmpt = 0; cmpt < tensor::nComponents; ++cmpt)
        {
            tensor d(tensor::zero);
            d[cmpt] = 1;

            bool smooth = true;

            // Fourth-order central difference
            symmTensor difference(symmTensor::zero);
            for (const label i : {-2, -1, 1, 2})
            {
                const scalar weight =
                    (i > 0 ? 1 : -1) * (std::abs(i) == 1 ? 8 : -1) / (12 * h);

                elastoViscoPlastic::response aside;
                material_.update(
                    gradU + i * h * d,
                    dt,
                    now_.s,
                    now_.epsP,
                    now_.damaged,
                    aside
                );

                difference += weight * aside.s;
                smooth = smooth && (aside.dEpsP > 0) == (r.dEpsP > 0)
                    && std::abs(aside.dqdqTrial - r.dqdqTrial) < 0.02;
            }

            if (smooth)
            {
                // Directions in which hardly anything happens are compared
                // with the others: their differences are roundoff
                result.error =
                    max(result.error,
                        mag(difference - exact[cmpt])
                            / max(mag(exact[cmpt]), 1e-3 * largest));
                ++result.directions;
            }
        }
    }

    return result;
}


// ************************************************************************* //
