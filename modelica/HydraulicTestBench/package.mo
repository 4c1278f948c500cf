within ;
package HydraulicTestBench "Hydraulic pump control on a test bench, with slots for the physics a model may lack"
  extends Icons.Package;
  annotation(
    version="0.1.0",
    Documentation(info="<html>
<p>A Bosch Rexroth A4VSG pump whose swash plate is moved by a valve-controlled cylinder and a controller card. Start
with
<code>UsersGuide</code>; the model is <code>Pump.SwashPlateControl</code>.</p>
<p>The library loads alone. Its flanges and signals are those of the Modelica Standard Library.</p>
<p><b>Source:</b> S. S. T&oslash;rdal and A. Klausen, <i>System Identification of a Variable Piston Pump and Design of a
Hydraulic Load Circuit</i>, master's thesis, University of Agder, 2015; called the thesis throughout.</p>
</html>"));
end HydraulicTestBench;
