"""Kinds of studies that a project may design, each a module with the same names.

    NAME, DATABASE, MOVED      for messages; "needed", "allowed" or "none"; whether motions may have a factor
    check(project, raw)        raises StudyError for what a project asks and the kind has not
    read(path)                 raw tables and text of a study, checked
    base(raw, db)              tables of the study, in which all that may be lost has a name and stays where it is laid
    at(base, depth, weather)   tables of a load case; weather : raw tables wind, current, waves, with incidence_deg
    checked(study, body, folder)  raises ValueError for a load case that could not be run on a `moor.checked.Body`
    words(project, raw)        the command that gives a case's numbers again, where they are, what the method is
    needs(raw), finds(raw)     [`Need`] of what the study has; quantities beyond tensions that its cases may find
    lost(study)                names of what may be lost; without(study, name) the tables without one of them
    run(study, database, path, factors)   `Numbers` of a load case, and those of its runs in time or None
    draw(study, database, numbers, path)  a plan of it
    body(raw)                  words on the body, where no database is needed

A study is of the kind whose tables it has.
"""
