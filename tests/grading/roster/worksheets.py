"""Grading worksheets in Moodle's format, in several languages and with several settings."""

from __future__ import annotations

DATE = '"Monday, 5 October 2026, 10:00 AM"'
# This file has the format of a new English Moodle site, with group submission, marking workflow and online
# text.
ENGLISH = (
    '\ufeffIdentifier,"Full name","ID number","Email address",Status,Group,Marker,Grade,"Maximum grade",'
    '"Marking workflow state","Grade can be changed","Last modified (submission)","Online text",'
    '"Last modified (grade)","Feedback comments"\n'
    '"Participant 101","Jane Doe",4711,jane@uni.example,'
    f'"Submitted for grading",,,,100.00,"Not marked",Yes,{DATE},'
    '"<p>See the ""file"",\nplease</p>",-,\n'
    '"Participant 102","Max Müller",4712,max@uni.example,'
    f'"Submitted for grading",,,50.00,100.00,Released,Yes,{DATE},,'
    f'{DATE},"<p>old</p>"\n'
    '"Participant 103","Ann Lee",4713,ann@uni.example,"No submission",,,,100.00,"Not marked",Yes,-,,-,\n'
    '"Participant 104","Bo Li",4714,bo@uni.example,"Submitted for grading",'
    f",,10.00,100.00,Released,No,{DATE},,-,kept\n"
)
# This file has the format of a German site: all cells are quoted, and numbers have decimal commas.
GERMAN = (
    '"ID","Vollständiger Name","E-Mail-Adresse","Status","Bewertung","Bestwertung",'
    '"Bewertung kann geändert werden","Zuletzt geändert (Abgabe)","Zuletzt geändert (Bewertung)",'
    '"Feedback als Kommentar"\r\n'  # codespell:ignore als
    '"Teilnehmer/in101","Jane Doe","jane@uni.example",'
    '"Zur Bewertung abgegeben","","10,00","Ja","-","-",""\r\n'
    '"Teilnehmer/in102","Max Müller","max@uni.example",'
    '"Zur Bewertung abgegeben","","10,00","Ja","-","-",""\r\n'
)
# This file has the format of a French site, and a spreadsheet program saved it with semicolons.
FRENCH = (
    "Identifiant;Nom complet;Adresse de courriel;Statut;"  # codespell:ignore complet,adresse
    "Note;Note maximale;La note peut être modifiée;"
    "Dernière modification (note);Feedback par commentaires\n"
    "Participant101;Jane Doe;jane@uni.example;Remis;;20,00;Oui;-;\n"
)
SPANISH = (
    '"Identificador","Nombre completo","Dirección de correo","Estado","Calificación","Calificación máxima",'
    '"La calificación puede ser cambiada","Última modificación (entrega)",'  # codespell:ignore ser
    '"Última modificación (calificación)","Comentarios de retroalimentación"\n'
    '"Participante 101","Jane Doe","jane@uni.example","Enviado","","9,00","Sí","-","-",""\n'
)
# This file contains anonymous submissions, without feedback comments and without a maximum grade.
ANONYMOUS = (
    "Identifier,Status,Grade,Grade can be changed,Last modified (grade)\n"
    "Participant 101,Submitted for grading,,Yes,-\n"
)
SCALE = "Identifier,Full name,Status,Grade,Scale,Grade can be changed,Last modified (grade)\n"
