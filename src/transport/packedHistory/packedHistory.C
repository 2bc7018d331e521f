// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "packedHistory.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

template<class Operation>
void Foam::packedHistory::forCarried(const Operation& op)
{
    label first = 0;
    for (historyVariable& v : history_.all())
    {
        if (v.how() == historyVariable::STANDS) continue;
        SubList<scalarField> components(all_, v.nComponents(), first);
        op(v, components, first);
        first += v.nComponents();
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::packedHistory::packedHistory(
    historyVariables& history,
    const scalar bulkModulus,
    const tensor& axes
) :
    history_(history),
    K_(bulkModulus),
    axes_(axes),
    damage_(-1),
    rho_(history.mesh().nCells(), 1),
    shrunk_(history.mesh().nCells(), 1)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::packedHistory::pack()
{
    label nAll = 0;
    for (const historyVariable& v : history_.all())
    {
        if (v.how() != historyVariable::STANDS) nAll += v.nComponents();
    }
    all_.setSize(nAll);

    used_.clear();
    damage_ = -1;
    label pressure = -1;
    label damage = -1;
    forCarried(
        [&](const historyVariable& v, UList<scalarField>& q, const label first)
        {
            v.components(axes_, q);
            if (v.how() == historyVariable::PRESSURE) pressure = first;
            if (v.how() == historyVariable::DAMAGE) damage = first;

            // What is nowhere stays so; the pressure moves always
            scalarField most(q.size());
            forAll(q, d) most[d] = gMax(mag(q[d]));
            const scalar nothing = v.noise() * max(most);
            forAll(q, d)
            {
                if (most[d] > nothing && first + d != pressure)
                {
                    used_.append(first + d);
                }
            }
        }
    );
    used_.append(pressure);
    Swap(used_.first(), used_.last());
    damage_ = damage < 0 ? -1 : used_.find(damage);

    const label n = used_.size();
    const label nCells = history_.mesh().nCells();
    values_.setSize(nCells * n);
    forAll(used_, k)
    {
        const scalarField& q = all_[used_[k]];
        forAll(q, c) values_[c * n + k] = q[c];
    }
    for (label c = 0; c < nCells; ++c) compress(c);
}


void Foam::packedHistory::unpack()
{
    const label n = used_.size();
    for (scalarField& q : all_) q = 0;
    forAll(used_, k)
    {
        scalarField& q = all_[used_[k]];
        forAll(q, c) q[c] = values_[c * n + k];
    }
    forCarried([&](historyVariable& v, const UList<scalarField>& q, const label)
        { v.setComponents(axes_, q); });
}

// ************************************************************************* //
