"""Kinds of studies that a project may design; each kind is a module with these names.

    NAME, DATABASE, MOVED      for messages; "needed", "allowed" or "none"; whether motions may have a factor
    check(project, raw)        raises StudyError for a part of the project that this kind does not have
    read(path)                 raw tables and text of a study, checked
    base(raw, db)              tables of the study, in which all that may be lost has a name and a fixed layout
    at(base, depth, weather)   tables of a load case; weather : raw tables wind, current, waves, with incidence_deg
    checked(study, body, folder)  raises ValueError for a load case that could not be run on a `moor.checked.Body`
    words(project, raw)        the command that repeats a case, the place of its numbers, the method
    needs(raw), finds(raw)     [`Need`] of the parts of the study; quantities besides tensions that its cases may give
    lost(study)                names of parts that may be lost; without(study, name) the tables without one of them
    run(study, database, path, factors)   `Numbers` of a load case, and those of its runs in time or None
    draw(study, database, numbers, path)  a plan of it
    body(raw)                  words on the body, where no database is needed

The kind of a study is determined by its tables.
"""
