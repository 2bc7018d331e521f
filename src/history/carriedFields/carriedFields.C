// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "carriedFields.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::carriedFields::carriedFields(
    const dictionary& bolusDict,
    bolusState& bolus
)
{
    const fvMesh& mesh = bolus.history.mesh();
    wordList names;
    if (bolusDict.found("fields"))
    {
        entryReader(bolusDict).requireList(
            "fields", "names of fields that the bolus carries"
        );
        names = bolusDict.get<wordList>("fields");
    }

    for (const word& name : names)
    {
        if (mesh.foundObject<regIOobject>(name))
        {
            FatalIOErrorInFunction(bolusDict)
                << "entry fields: " << name << " is the name of another field;"
                << " valid is any name but " << mesh.sortedNames()
                << exit(FatalIOError);
        }
        append(
            carriedField::New(
                name, bolusDict.subOrEmptyDict(name + "Coeffs"), bolus
            )
        );
    }

    // Misspelt coefficients would otherwise be the defaults, in silence
    wordList chosen(names);
    chosen.append(
        bolusDict.lookupOrDefault<wordList>("phases", {"bolus", "gas"})
    );
    chosen.append(bolusDict.lookupOrDefault<wordList>("forces", wordList()));
    for (const entry& e : bolusDict)
    {
        const word& key = e.keyword();
        if (key.endsWith("Coeffs")
            && !chosen.found(key.substr(0, key.size() - 6)))
        {
            FatalIOErrorInFunction(bolusDict)
                << "entry " << key << ": of no field, phase or force; valid are"
                << " coefficients of those chosen: " << chosen
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::carriedFields::evolve(const scalar deltaT)
{
    for (carriedField& f : *this) f.evolve(deltaT);
}

// ************************************************************************* //
