// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "energyBooks.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::energyBooks::elasticEnergy() const
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


Foam::scalar Foam::energyBooks::kineticEnergy() const
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


Foam::scalar Foam::energyBooks::get(const word& name) const
{
    return lookupOrDefault<scalar>(name, 0);
}


void Foam::energyBooks::keep(const word& name, const scalar energy)
{
    // As a token: set() would round to the digits that are written
    IOdictionary::add(name, energy, true);
}


void Foam::energyBooks::add(const word& name, const scalar energy)
{
    keep(name, get(name) + energy);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::energyBooks::energyBooks(
    const Time& time,
    const bolusFields& fields,
    const elastoViscoPlastic& law,
    const scalar inertia
) :
    IOdictionary(IOobject(
        "energyBooks",
        time.timeName(),
        "uniform",
        time,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    )),
    fields_(fields),
    law_(law),
    inertia_(inertia)
{
    // For those who read these books (energyBalance)
    set("parts", parts());

    if (found("walls")) return;

    keep("walls", 0);
    keep("closure", 0);
    // Strains of some 1e-5 all over: less work than that counts as none
    keep("largestWork", 1e-9 * law.elastic().G() * fields.totalMass());
    keep("residual", 0);
    for (const word& part : parts()) keep(part, 0);

    // What is there at the start is nobody's work
    keep("elasticNow", elasticEnergy());
    keep("kineticNow", kineticEnergy());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::wordList& Foam::energyBooks::parts()
{
    static const wordList names(
        {"elastic",
            "slip",
            "kinetic",
            "plastic",
            "friction",
            "fracture",
            "void",
            "debris",
            "relaxation",
            "hourglass",
            "overfill",
            "transport",
            "outflow",
            "inertiaLoss"}
    );
    return names;
}


void Foam::energyBooks::step(const coupledSystem& system, const scalar deltaT)
{
    const stepPower& P = system.power();

    // What bolus that left took along, as it was before the transport
    scalar out = 0;
    for (const fvsPatchScalarField& F : fields_.massFlux.boundaryField())
    {
        if (F.coupled()) continue;
        const labelUList& cells = F.patch().faceCells();
        forAll(F, i) out += F[i] * system.elasticEnergy()[cells[i]];
    }

    const word names[] = {
        "walls",
        "closure",
        "elastic",
        "plastic",
        "relaxation",
        "fracture",
        "void",
        "debris",
        "hourglass",
        "overfill",
        "friction",
        "inertiaLoss",
        "outflow"
    };
    scalarField sums(
        {P.walls,
            P.closure,
            P.elastic,
            P.plastic,
            P.relaxation,
            P.fracture,
            P.voids,
            P.debris,
            P.hourglass,
            P.overfill,
            P.friction,
            P.inertia,
            out,
            P.slipEnergy / deltaT}
    );
    reduce(sums, sumOp<scalarField>());
    for (scalar& sum : sums) sum *= deltaT;

    label i = 0;
    for (const word& name : names) add(name, sums[i++]);
    const scalar solved = sums[2];
    const scalar outflow = sums[12];
    const scalar slip = sums[13];

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
    for (const word& part : parts()) R -= get(part);
    keep("residual", R);
    keep("largestWork", max(get("largestWork"), mag(work)));
}


Foam::scalar Foam::energyBooks::residual() const
{
    return get("residual") / get("largestWork");
}


void Foam::energyBooks::report() const
{
    const scalar work = get("walls") + get("closure");
    Info << "    work             " << work << " J on the mesh; of this" << nl;
    for (const word& part : parts())
    {
        if (get(part) == 0) continue;
        const std::string gap(13 - part.size(), ' ');
        Info << "        " << part << gap.c_str()
             << 100 * get(part) / get("largestWork") << " %" << nl;
    }
    Info << "    energy residual  " << residual() << " of the work" << nl;
}


bool Foam::energyBooks::writeData(Ostream& os) const
{
    const int digits = os.precision(16);
    const bool ok = IOdictionary::writeData(os);
    os.precision(digits);
    return ok;
}

// ************************************************************************* //
