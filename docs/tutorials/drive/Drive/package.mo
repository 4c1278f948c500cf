package Drive "Positioning drive: motor, spindle, carriage, cascaded control"
end Drive;
