// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "energyLedger.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::energyLedger::elasticEnergy() const
{
    const scalar K = law_.elastic().K();
    const scalar G = law_.elastic().G();
    const scalarField& V = fields_.alpha.mesh().V();

    scalar E = 0;
    forAll(V, c)
    {
        E += fields_.alpha[c] * V[c]
            * (magSqr(fields_.deviator[c]) / (4 * G)
                + sqr(fields_.p[c]) / (2 * K));
    }
    return returnReduce(E, sumOp<scalar>());
}


Foam::scalar Foam::energyLedger::kineticEnergy() const
{
    if (inertia_ == 0) return 0;

    const scalarField& V = fields_.alpha.mesh().V();
    scalar T = 0;
    forAll(V, c)
    {
        T += 0.5 * inertia_ * law_.rho() * fields_.mass[c] * V[c]
            * magSqr(fields_.U[c]);
    }
    return returnReduce(T, sumOp<scalar>());
}


Foam::scalar Foam::energyLedger::get(const word& name) const
{
    return lookupOrDefault<scalar>(name, 0);
}


void Foam::energyLedger::keep(const word& name, const scalar energy)
{
    // As a token: set() would round to the digits that are written
    IOdictionary::add(name, energy, true);
}


void Foam::energyLedger::add(const word& name, const scalar energy)
{
    keep(name, get(name) + energy);
}


namespace Foam
{

//- The name of a power in the books: of inertia's a part is stored
static word booked(const word& power)
{
    return power == "inertia" ? word("inertiaLoss") : power;
}


static wordList partsOf(const powerLedger& ledger)
{
    DynamicList<word> parts({"elastic", "slip", "kinetic"});
    for (const word& name : ledger.names())
    {
        if (name == "walls" || name == "closure" || name == "elastic") continue;
        parts.append(booked(name));
    }
    parts.append("transport");
    parts.append("outflow");
    return wordList(parts);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::energyLedger::energyLedger(
    const Time& time,
    const bolusFields& fields,
    const elastoViscoPlastic& law,
    const coupledSystem& system
) :
    IOdictionary(IOobject(
        "energyLedger",
        time.timeName(),
        "uniform",
        time,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    )),
    fields_(fields),
    law_(law),
    inertia_(system.inertia()),
    parts_(partsOf(system.accepted().power))
{
    // For those who read these books (energyBalance)
    IOdictionary::add("parts", parts_, true);
    for (const word& part : parts_) keep(part, get(part));
    if (found("walls")) return;

    keep("walls", 0);
    keep("closure", 0);
    // Strains of some 1e-5 all over: less work than that counts as none
    keep("largestWork", 1e-9 * law.elastic().G() * fields.totalMass());
    keep("residual", 0);

    // What is there at the start is nobody's work
    keep("elasticNow", elasticEnergy());
    keep("kineticNow", kineticEnergy());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::energyLedger::step(const coupledSystem& system, const scalar deltaT)
{
    const coupledSystem::solution& now = system.accepted();

    // What bolus that left took along, as it was before the transport
    scalar out = 0;
    for (const fvsPatchScalarField& F : fields_.massFlux.boundaryField())
    {
        if (F.coupled()) continue;
        const labelUList& cells = F.patch().faceCells();
        forAll(F, i) out += F[i] * now.elasticEnergy[cells[i]];
    }
    const scalar outflow = returnReduce(out, sumOp<scalar>()) * deltaT;
    const scalar slip = returnReduce(now.slipEnergy, sumOp<scalar>());

    scalar solved = 0;
    for (const word& name : now.power.names())
    {
        const scalar energy =
            returnReduce(now.power[name], sumOp<scalar>()) * deltaT;
        add(booked(name), energy);
        if (name == "elastic") solved = energy;
    }
    add("outflow", outflow);

    // Of the work on the slip a part is stored
    add("friction", get("slip") - slip);
    keep("slip", slip);

    // Transport and outflow take from what the solution left
    const scalar grown = elasticEnergy() - get("elasticNow");
    add("elasticNow", grown);
    add("elastic", grown - solved);
    add("transport", solved - grown - outflow);

    const scalar faster = kineticEnergy() - get("kineticNow");
    add("kineticNow", faster);
    add("kinetic", faster);
    add("inertiaLoss", -faster);

    const scalar work = get("walls") + get("closure");
    scalar R = work;
    for (const word& part : parts_) R -= get(part);
    keep("residual", R);
    keep("largestWork", max(get("largestWork"), mag(work)));
}


Foam::scalar Foam::energyLedger::residual() const
{
    return get("residual") / get("largestWork");
}


void Foam::energyLedger::report() const
{
    const scalar work = get("walls") + get("closure");
    Info << "    work             " << work << " J on the mesh; of this" << nl;
    for (const word& part : parts_)
    {
        if (get(part) == 0) continue;
        const std::string gap(part.size() < 18 ? 18 - part.size() : 1, ' ');
        Info << "        " << part << gap.c_str()
             << 100 * get(part) / get("largestWork") << " %" << nl;
    }
    Info << "    energy residual  " << residual() << " of the work" << nl;
}


bool Foam::energyLedger::writeData(Ostream& os) const
{
    const int digits = os.precision(16);
    const bool ok = IOdictionary::writeData(os);
    os.precision(digits);
    return ok;
}

// ************************************************************************* //
