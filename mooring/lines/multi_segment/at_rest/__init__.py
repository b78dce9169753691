"""Lines that come to rest on a bed without friction: a falling chain, its contacts and the equations of those"""
