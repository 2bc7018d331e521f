// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "loadingSegment.H"

#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::loadingSegment::loadingSegment(const dictionary& dict) :
    name_(dict.dictName())
{
    entryReader read(dict);

    mode_ = materialSpecimen::loadingNames[read.choice(
        "mode", "mode of loading", materialSpecimen::loadingNames.names()
    )];

    const bool hasStrain = read.has("strain");
    const bool hasDuration = read.has("duration");
    const bool hasUnload = read.has("unload");

    if (label(hasStrain) + label(hasDuration) + label(hasUnload) != 1)
    {
        FatalIOErrorInFunction(dict)
            << "Segment " << name_ << " has "
            << (label(hasStrain) + label(hasDuration) + label(hasUnload))
            << " goals; valid is exactly one of the entries strain (target "
            << "[-]), duration (hold [s]) and unload (yes)"
            << exit(FatalIOError);
    }

    if (hasDuration)
    {
        goal_ = goal::duration;
        rate_ = 0;
        target_ =
            read.number("duration", "time to hold [s]", entryReader::positive);

        // A rate makes no sense here, and rejectOthers() says so
    }
    else
    {
        goal_ = hasStrain ? goal::strain : goal::unload;
        rate_ = read.number(
            "rate", "magnitude of the strain rate [1/s]", entryReader::positive
        );
        target_ = hasStrain
            ? read.number(
                  "strain",
                  "target of the logarithmic or shear strain [-]",
                  {-20, true, 20, true}
              )
            : 0;

        if (hasUnload)
        {
            read.choice("unload", "unload", wordList({"yes", "on", "true"}));
        }
    }

    read.rejectOthers();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::loadingSegment::goToStrain(
    materialSpecimen& specimen,
    const scalar maxStrainIncrement,
    const observer& observe
) const
{
    const scalar way =
        target_ - materialSpecimen::strain(mode_, specimen.now());
    const label n = label(std::ceil(std::abs(way) / maxStrainIncrement));
    const scalar dt = std::abs(way) / rate_ / max(n, label(1));

    for (label i = 1; i <= n; ++i)
    {
        specimen.accept(specimen.trial(mode_, way > 0 ? rate_ : -rate_, dt));
        observe(dt, scalar(i) / n);
    }
}


void Foam::loadingSegment::hold(
    materialSpecimen& specimen,
    const scalar maxStrainIncrement,
    const observer& observe
) const
{
    const scalar begin = specimen.now().t;

    // The state relaxes at first as fast as it was loaded
    const scalar lastRate = mag(specimen.now().gradU);
    scalar dt = lastRate > 0
        ? min(maxStrainIncrement / lastRate, 0.01 * target_)
        : 0.01 * target_;

    for (scalar left = target_; left > 0;)
    {
        // No sliver of a last step
        dt = left < 1.5 * dt ? left : dt;

        specimen.accept(specimen.trial(mode_, 0, dt));
        left = dt < left ? begin + target_ - specimen.now().t : 0;
        observe(dt, 1 - left / target_);

        const scalar dEpsP = specimen.now().dEpsP;
        dt *= dEpsP > 0 ? min(1.01, maxStrainIncrement / dEpsP) : 1.01;
    }
}


void Foam::loadingSegment::unload(
    materialSpecimen& specimen,
    const scalar maxStrainIncrement,
    const observer& observe
) const
{
    const scalar stress0 = materialSpecimen::stress(mode_, specimen.now());
    const scalar rate = stress0 > 0 ? -rate_ : rate_;
    const scalar tolerance = 1e-9 * std::abs(stress0);

    scalar stress = stress0;

    while (std::abs(stress) > tolerance)
    {
        scalar dt = maxStrainIncrement / rate_;
        materialSpecimen::state next = specimen.trial(mode_, rate, dt);
        scalar nextStress = materialSpecimen::stress(mode_, next);

        // Shorten a step that crosses zero until it ends there or before
        while (nextStress * stress < 0 && std::abs(nextStress) > tolerance)
        {
            dt *= stress / (stress - nextStress);
            next = specimen.trial(mode_, rate, dt);
            nextStress = materialSpecimen::stress(mode_, next);
        }

        specimen.accept(next);
        stress = nextStress;
        observe(dt, 1 - min(std::abs(stress / stress0), scalar(1)));
    }
}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

void Foam::loadingSegment::apply(
    materialSpecimen& specimen,
    const scalar maxStrainIncrement,
    const observer& observe
) const
{
    switch (goal_)
    {
        case goal::strain:
        {
            goToStrain(specimen, maxStrainIncrement, observe);
            break;
        }
        case goal::duration:
        {
            hold(specimen, maxStrainIncrement, observe);
            break;
        }
        case goal::unload:
        {
            unload(specimen, maxStrainIncrement, observe);
            break;
        }
    }
}


// ************************************************************************* //
