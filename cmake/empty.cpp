// A library whose sources are all in its folders starts from this empty unit.
